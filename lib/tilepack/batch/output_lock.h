#pragma once

#include <functional>
#include <string>

namespace tilepack {

/// What to do where another process writes the same output.
enum class WhenBusy { refuse, wait };

/// While it lives, no other process that asks for it has the lock on `output`: a pack's folder or a file, which
/// need not exist. It is a lock on a file in the user's folder for such (XDG_RUNTIME_DIR, else the folder for
/// temporary files), so outputs show no trace of it, and it goes with the process however that ends. Processes of
/// other users and machines are kept out by the shorter lock of StagedFolder alone.
class OutputLock {
public:
  /// Calls `waiting` every few hundredths of a second while it waits, with who has the lock ("process 4711");
  /// that may throw to give up. Throws Error (cannot_write) with who writes if the output is busy and it isn't to
  /// wait. Where no lock can be had, there is none.
  OutputLock(const std::string& output, WhenBusy when,
             const std::function<void(const std::string& who)>& waiting = {});
  ~OutputLock();
  OutputLock(const OutputLock&) = delete;
  OutputLock& operator=(const OutputLock&) = delete;

  /// Whether another process had it first: what it wrote has to be looked at again.
  bool has_waited() const { return waited; }

private:
  std::string file;
  int descriptor = -1;
  bool waited = false;
};

} // namespace tilepack
