#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <utility>

/// What files, sockets and pipes have in common, here and in gale-hdf5-reader.
namespace gale::io::detail {

/// A descriptor, which closes itself; none if it is below 0.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() { close(); }
  operator int() const { return number_; }

  /// Hands it over: whoever takes it closes it.
  int release() { return std::exchange(number_, -1); }

  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

/// Calls move(done, rest) until `bytes` bytes are moved, `most` at a time: it moves some of the rest, as read() and
/// write() do, and returns how many. False where it returned 0, with errno 0, or failed, with errno as it was left.
template <class Move>
bool move_all(std::size_t bytes, const Move& move, std::size_t most = std::size_t(1) << 30) {
  for (std::size_t done = 0; done < bytes;) {
    const ssize_t moved = move(done, std::min(most, bytes - done));
    if (moved < 0 && errno == EINTR) continue;
    if (moved == 0) errno = 0;
    if (moved <= 0) return false;
    done += static_cast<std::size_t>(moved);
  }
  return true;
}

}  // namespace gale::io::detail
