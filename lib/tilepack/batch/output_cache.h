#pragma once

#include "tilepack/batch/batch_entry.h"
#include "tilepack/batch/build_record.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace tilepack {

/// Finished outputs by the hash of what they are made from, in a folder that many processes on many machines may
/// share: an output is one file, written under another name, flushed to disk and then renamed, so that whoever
/// finds it finds it whole; there is no lock. A file whose content is not what its head says is taken for none.
class OutputCache {
public:
  /// `folder` is made when first written to.
  explicit OutputCache(std::string folder) : root(std::move(folder)) {}

  /// Puts the output that `key` stands for in place, as a bake would, with its side file, which says that it was
  /// made from `inputs`. False if it is not there, damaged (then it is thrown away) or can't be read, and then the
  /// output is as it was. Throws Error (cannot_write) if it can't be put there.
  bool restore(const ContentHash& key, const BatchEntry& entry, const BuildInputs& inputs) const;

  /// Keeps the output of `entry`. Throws Error (cannot_write), and then nothing is kept.
  void keep(const ContentHash& key, const BatchEntry& entry, const std::vector<HashedFile>& files) const;

  /// Removes what was used longest ago until no more than `most_bytes` are left, and what killed writers left.
  void shrink_to(std::int64_t most_bytes) const;

  /// The file that holds the output of `key`.
  std::string file_of(const ContentHash& key) const;

private:
  std::string root;
};

} // namespace tilepack
