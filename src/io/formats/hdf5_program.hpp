#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gale/io/program/protocol.hpp>

namespace gale::io::detail {

/// A descriptor, which closes itself; none if it is below 0.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  ~Descriptor() { close(); }
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  operator int() const { return number_; }
  void close();

 private:
  int number_;
};

/// gale-hdf5-reader with a file, and what passes between it and us.
class Hdf5Program {
 public:
  /// Throws gale::Error if it isn't there, or can't be run.
  explicit Hdf5Program(const std::string& path);
  ~Hdf5Program();
  Hdf5Program(const Hdf5Program&) = delete;
  Hdf5Program& operator=(const Hdf5Program&) = delete;

  /// `texts` have no zeros.
  void ask(reader::Request request, const std::vector<std::string>& texts);

  /// What it answers next. Throws gale::Error with what it says, or how it ended.
  void receive(void* to, std::size_t bytes);
  template <class T>
  T receive() {
    T value;
    receive(&value, sizeof value);
    return value;
  }
  std::string receive_text(std::uint32_t most);

 private:
  /// Waits until it has ended; returns its status.
  int wait();
  [[noreturn]] void throw_end();

  Descriptor talk_, message_;
  pid_t process_ = -1;
};

}  // namespace gale::io::detail
