#pragma once

#include <cstdlib>
#include <stdexcept>
#include <unistd.h>

namespace tilepack::test {

/// While it lives, root, to whom no file is closed, is another user; whoever is not root stays who they are.
class Unprivileged {
public:
  Unprivileged() : was_root(geteuid() == 0) {
    if (was_root && seteuid(nobody) != 0) throw std::runtime_error("root can't become another user");
  }
  ~Unprivileged() {
    if (was_root && seteuid(0) != 0) std::abort();
  }
  Unprivileged(const Unprivileged&) = delete;
  Unprivileged& operator=(const Unprivileged&) = delete;

private:
  static constexpr uid_t nobody = 65534;
  bool was_root;
};

} // namespace tilepack::test
