#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gale/io/bytes/input_file.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/dataset.hpp>

namespace gale::io::detail {

/// An array of a file that has many: a variable of NetCDF's, a dataset of HDF5's.
struct FileArray {
  std::string name;
  std::optional<ValueType> type;  ///< int8 for characters; nothing for what is neither these nor numbers
  bool is_text = false;
  ByteOrder order = ByteOrder::little;
  std::vector<std::uint64_t> shape;  ///< the last dimension runs fastest; none for a single value

  std::uint64_t rows() const { return shape.empty() ? 1 : shape.front(); }

  /// How many values are in `rows` rows, places of the first dimension. Throws gale::Error if no file has so many.
  std::uint64_t count(std::uint64_t rows) const;
};

/// The value of an attribute, characters or numbers.
struct FileAttribute {
  std::string text;
  std::vector<double> numbers;
};

/// A file of arrays with names and shapes.
class ArrayFile {
 public:
  explicit ArrayFile(const InputFile& file) : file_(file) {}
  virtual ~ArrayFile() = default;
  ArrayFile(const ArrayFile&) = delete;
  ArrayFile& operator=(const ArrayFile&) = delete;

  /// nullptr if there is none of that name.
  virtual const FileArray* find(const std::string& name) const = 0;

  /// The array of that name. Throws gale::Error if there is none, or it has no values.
  const FileArray& require(const std::string& name) const;

  /// The length of a dimension of NetCDF's.
  virtual std::optional<std::uint64_t> dimension(const std::string& name) const = 0;

  /// An attribute of an array; nothing if it has none of that name.
  virtual std::optional<FileAttribute> attribute(const std::string& array, const std::string& name) = 0;

  /// Some rows, which follow each other.
  struct Rows {
    std::uint64_t count, first = 0;
  };

  /// These rows. Throws gale::Error if the array or the file hasn't got them, or if more is read altogether than the
  /// file has bytes: arrays may not lie on each other, or a small file would stand for a large mesh.
  PointArray::Values read(const FileArray& array, Rows rows);
  PointArray::Values read(const FileArray& array) { return read(array, {array.rows()}); }

 protected:
  /// Throws gale::Error unless the file has these rows, one at least, which are of `bytes` bytes: memory is taken then.
  /// Returns how many bytes they are as they are stored, or more.
  virtual std::uint64_t stored_bytes(const FileArray& array, Rows rows, std::uint64_t bytes) = 0;

  /// Copies them to `to`, in the file's order of bytes, all of them.
  virtual void copy(const FileArray& array, Rows rows, char* to, std::uint64_t bytes) = 0;

  const InputFile& file_;

 private:
  std::uint64_t read_bytes_ = 0;
};

/// How files of NetCDF's classic forms and of HDF5 begin.
inline constexpr char netcdf_magic[] = "CDF", hdf5_magic[] = "\x89HDF\r\n\x1a\n";

/// A file of NetCDF's classic forms, which must outlive what is returned.
std::unique_ptr<ArrayFile> open_netcdf(const InputFile& file);

}  // namespace gale::io::detail
