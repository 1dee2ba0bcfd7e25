#include "tilepack/error/error.h"

#include <cstdio>

int main() {
  std::fputs("tilepack: no verb is built yet\n", stderr);
  return tilepack::exit_code(tilepack::ErrorKind::usage);
}
