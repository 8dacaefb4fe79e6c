#pragma once

#include <optional>
#include <string>
#include <vector>

#include <gale/io/bytes/values.hpp>
#include <gale/io/dataset.hpp>

namespace gale::io::detail {

/// A legacy `.vtk` file behind its first three lines: keywords, and values that are text or binary.
class LegacyFile {
 public:
  /// Reads the first three lines. Throws gale::Error if they are those of no such file.
  explicit LegacyFile(const InputFile& file);

  /// The format's version: from 5 on, cells are offsets and connectivity.
  int major_version() const { return major_version_; }

  /// The next keyword, in lower case; empty at the end. Skips metadata.
  std::string keyword();

  /// Skips what follows the word METADATA, up to an empty line.
  void skip_metadata();

  /// The next word as it is, with %20 and the like decoded. Throws gale::Error at the end. `what` it is.
  std::string name(const char* what);

  /// The next word as a number of things.
  std::int64_t count(const char* what);

  std::vector<double> numbers(std::size_t count, const char* what);

  /// The values of an array, whose type has just been read; nothing for one whose values aren't numbers, which are
  /// skipped then.
  std::optional<PointArray::Values> array(const std::string& type, std::uint64_t count);

  /// Reads an array that has to be of numbers. `what` it holds.
  PointArray::Values array_of_numbers(std::uint64_t count, const char* what);

  /// Values of cells, which have no type in the file.
  std::vector<std::int32_t> integers(std::uint64_t count);

  /// Color scalars: bytes, which a text writes as numbers from 0 to 1.
  PointArray::Values colors(std::uint64_t count);

  /// Skips a lookup table of so many colors.
  void skip_table(std::uint64_t colors);

 private:
  PointArray::Values values(ValueType type, std::uint64_t count);
  void skip_words(std::uint64_t count);
  void skip_bytes(std::uint64_t count);
  void skip_strings(std::uint64_t count);
  void end_line();

  FileBytes bytes_;
  TextReader text_;
  int major_version_ = 0;
  bool binary_ = false;
};

/// The numeric arrays of points or cells, the first scalars first.
struct LegacyAttributes {
  std::vector<PointArray> arrays;
  std::vector<std::string> names;     ///< the names of all
  std::vector<std::string> left_out;  ///< a notice about each whose values are no numbers
  bool has_scalars = false;
};

/// Reads an attribute of `count` points or cells, whose keyword was read. False, with nothing read, if the keyword
/// begins none. Throws gale::Error for an array of another size.
bool read_attribute(LegacyFile& file, const std::string& keyword, std::uint64_t count, LegacyAttributes& to);

/// Reads a field, whose keyword was read: arrays with sizes of their own, which have to be `*count` unless that is
/// nullptr.
void read_field(LegacyFile& file, const std::uint64_t* count, LegacyAttributes& to);

}  // namespace gale::io::detail
