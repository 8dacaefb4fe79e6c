#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gale/io/bytes/input_file.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/bytes/values.hpp>

/// PLY: a header that says which elements follow, how many of each, and which properties these have; then the values of
/// all, element by element, as text or binary.
namespace gale::io::detail {

/// A number, or a list of numbers, that each element of some kind has.
struct PlyProperty {
  std::string name;
  ValueType type = ValueType::float32;
  std::optional<ValueType> count_type{};  ///< of lists: the type of how many numbers follow
};

/// A kind of elements.
struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties{};

  bool has_lists() const;

  /// The place of the property of that name; nothing if there is none.
  std::optional<std::size_t> find(const std::string& property) const;
};

/// What is read of elements: an array for each number, the numbers of lists behind each other.
struct PlyColumns {
  std::vector<PointArray::Values> values;        ///< by property; of lists, or if not wanted, empty
  std::vector<std::vector<std::int64_t>> ends;   ///< of lists: where each ends among `numbers`
  std::vector<std::vector<std::int32_t>> lists;  ///< of lists: their numbers
};

/// A PLY file behind its header.
class PlyFile {
 public:
  /// Reads the header. Throws gale::Error if it is that of no such file.
  explicit PlyFile(const InputFile& file);

  /// The elements, which follow each other in that order.
  const std::vector<PlyElement>& elements() const { return elements_; }

  /// Reads the next element's values: all of its numbers, and of its lists those of that name, which have to be whole
  /// numbers. Memory is taken as they come. Throws gale::Error where the file has less.
  PlyColumns read(const PlyElement& element, const std::string& list);

  /// Skips the next element's values.
  void skip(const PlyElement& element);

 private:
  enum class Form { ascii, little, big };

  void read_header();
  void add_property(Words& words);
  template <class T>
  T value(const PlyElement& element, std::size_t property);
  std::int64_t integer(ValueType type, const PlyElement& element, std::size_t property);
  void require_to_come(const PlyElement& element) const;
  void read_records(const PlyElement& element, PlyColumns& to);
  void read_list(const PlyElement& element, std::size_t property, bool is_wanted, PlyColumns& to);

  FileBytes bytes_;
  TextReader text_;
  Form form_ = Form::ascii;
  std::vector<PlyElement> elements_;
};

}  // namespace gale::io::detail
