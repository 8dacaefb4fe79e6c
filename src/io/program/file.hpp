#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#ifdef GALE_TAKES_SYSTEM_LIBRARIES
#include <hdf5.h>
#else
#include <vtk_hdf5.h>
#endif

#include <gale/io/program/protocol.hpp>

namespace gale::reader {

/// An identifier of HDF5's, which closes itself.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close, const char* what);
  Handle(Handle&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle& operator=(Handle&&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

/// Throws std::runtime_error with what HDF5 says is wrong, and with what.
[[noreturn]] void fail(const std::string& what);

/// The groups and datasets of a file that lies in memory, by hard links alone.
class File {
 public:
  File(const void* image, std::size_t bytes);

  struct Description {
    std::string name;
    DatasetHeader fixed;
    std::vector<std::uint64_t> shape, chunk;
    std::vector<std::uint32_t> filters;
  };

  /// The datasets in a group, in the order of their names; false if there is no such group. Throws
  /// std::runtime_error for what another file has, or names in a way that isn't followed.
  bool list(const std::string& group, std::vector<Description>& datasets) const;

  struct Attribute {
    AttributeKind kind = AttributeKind::none;
    std::string text;
    std::vector<double> numbers;
  };
  Attribute attribute(const std::string& object, const std::string& name) const;

  Description describe(const std::string& path) const;

  /// Opens a dataset.
  Handle open(const std::string& path) const;

 private:
  /// Throws std::runtime_error unless each link of the path is a hard one; false if one isn't there.
  bool leads_somewhere(const std::string& path) const;

  Handle file_;
};

}  // namespace gale::reader
