#include "tilepack/batch/job_content.h"

#include "tilepack/error/error.h"

namespace tilepack {

ContentHash content_of(const BakeJob& job) {
  ContentHasher hasher;
  try {
    for (const std::string& file : files_read(job)) {
      hasher.add_field(file);
      hasher.add_field(hex(hash_if_there(file).value_or(ContentHash{})));
    }
  } catch (const Error& error) {
    hasher.add_field(error.what());
  }
  return hasher.value();
}

} // namespace tilepack
