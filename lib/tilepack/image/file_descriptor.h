#pragma once

#include <unistd.h>
#include <utility>

namespace tilepack {

/// An open file or folder of the system, closed when this is destroyed.
class FileDescriptor {
public:
  FileDescriptor() = default;
  explicit FileDescriptor(int opened) : number(opened) {} ///< negative: none
  ~FileDescriptor() { close(); }
  FileDescriptor(FileDescriptor&& from) noexcept : number(std::exchange(from.number, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& from) noexcept {
    if (this != &from) {
      close();
      number = std::exchange(from.number, -1);
    }
    return *this;
  }

  int get() const { return number; }
  explicit operator bool() const { return number >= 0; }
  void close() {
    if (number >= 0) ::close(std::exchange(number, -1));
  }

private:
  int number = -1;
};

} // namespace tilepack
