#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <gale/io/bytes/input_file.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/formats.hpp>

/// Common parts of the volume formats: a small header that says how the values of one array lie in a file.
namespace gale::io::detail {

/// How the values lie in the file.
enum class Packing { raw, text, compressed };

struct Volume {
  std::array<std::int64_t, 3> dimensions{1, 1, 1};
  std::int64_t components = 1;
  ValueType type = ValueType::uint8;
  ByteOrder order = byte_order_of_machine();

  /// Throws gale::Error unless dimensions and components are positive and fit int, and all values a file.
  std::uint64_t count() const;
  std::uint64_t bytes() const;

  /// Throws gale::Error unless the source has them all.
  PointArray::Values read(ByteSource& source) const;

  /// The values behind so many bytes of what a file's bytes from `begin` on stand for, which ends with them, where all
  /// of that is uncompressed at once; nothing where it isn't.
  std::optional<PointArray::Values> read_at_once(const InputFile& file, std::uint64_t begin,
                                                 std::uint64_t behind) const;

  /// The values behind so many bytes of what a file's bytes from `begin` on are or, compressed, stand for. Throws
  /// gale::Error unless the file has them all.
  PointArray::Values read(const InputFile& file, std::uint64_t begin, Packing packing, std::uint64_t behind = 0) const;

  /// An image with one array and nothing else.
  Image image(const std::string& name, PointArray::Values values) const;
};

/// An image whose voxels have the places from `low` up to `high`, of VTK's origin, spacing and direction. Throws
/// gale::Error unless it has voxels, whose positions are finite.
Image oriented_image(const std::array<std::int64_t, 3>& low, const std::array<std::int64_t, 3>& high,
                     const std::vector<double>& origin, const std::vector<double>& spacing,
                     const std::vector<double>& direction);

/// To be called when all that is wanted was read. Throws gale::Error if the source is at its end, compressed, and its
/// sum isn't that of what was read.
void check_sum(ByteSource& source);

/// Throws gale::Error if the image's voxels have no position.
void require_finite(const Image& image);

/// The path of a data file that a header names. Relative names begin at the header's folder. Throws gale::Error if it
/// leaves that folder, unless options.outside_files, and if it is one of options.outputs.
std::string path_of_data(const std::string& header, const std::string& name, const ReadOptions& options);

/// The most data files that a header may name.
inline constexpr std::size_t most_files = 100000;

/// The steps that a file is which has these times. Throws gale::Error for more than `most_files`, and for a time that
/// isn't finite. One time, or none, is one step, and no series.
std::vector<Step> steps_at(const InputFile& input, const std::vector<double>& times);

/// The place of the time to read, of so many, and a notice where it is the first of several that nobody chose. Throws
/// gale::Error if there is none of that place.
std::uint64_t chosen_time(const ReadOptions& options, std::uint64_t times, std::vector<std::string>& notices);

/// The names that a pattern such as `slice%03d.raw` makes for first, first + step, ... up to last. Throws gale::Error
/// for a pattern of another form, or for more than `most` names.
std::vector<std::string> names_of_pattern(const std::string& pattern, std::int64_t first, std::int64_t last,
                                          std::int64_t step, std::size_t most);

/// A header of text: fields with values, and the data files that it lists.
struct TextHeader {
  std::map<std::string, std::string> fields;
  std::vector<std::string> list;
  std::uint64_t end = 0;  ///< where in its file what follows it begins

  bool has(const std::string& field) const { return fields.count(field) > 0; }

  /// The value of a field; empty if it isn't there.
  const std::string& operator[](const std::string& field) const;

  /// Throws gale::Error for more fields than a header has.
  void set(const std::string& field, const std::string& value);

  /// Reads names of files, a line each, up to the end of the text or, if that ends it, an empty line. Throws
  /// gale::Error for too many.
  void read_list(TextReader& text, bool empty_line_ends_it);
};

}  // namespace gale::io::detail
