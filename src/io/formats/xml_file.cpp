#include <algorithm>
#include <atomic>
#include <cstring>
#include <memory>
#include <numeric>

#include <gale/base/error.hpp>
#include <gale/base/threads.hpp>
#include <gale/io/bytes/base64.hpp>
#include <gale/io/bytes/compression.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/formats/xml_file.hpp>

namespace gale::io::detail {
namespace {

std::optional<ValueType> type_of(const XmlElement& array) { return find_type(xml_types, array.attribute("type")); }

/// Names the array in messages.
std::string its(const XmlElement& array) { return "its array '" + printable(array.attribute("Name")) + "'"; }

/// The bytes of one array that isn't text: raw, or base64 whose pieces, a header and values, may be padded each.
class Binary {
 public:
  Binary(const XmlFile& file, const XmlElement& array) : file_(file) {
    const std::string format = array.attribute("format", "ascii");
    if (format == "appended") {
      if (file.appended_begin == 0) damaged(its(array), " is appended, but nothing is");
      const std::uint64_t offset = array.number("offset"), behind = file.file.size() - file.appended_begin;
      if (offset > behind) damaged(its(array), " begins at ", offset, " of ", behind, " appended bytes");
      inner_ = std::make_unique<FileBytes>(file.file, file.appended_begin + offset);
    } else if (format == "binary") {
      inner_ = std::make_unique<MemoryBytes>(array.text);
    } else {
      damaged(its(array), " has the format '", format, "'");
    }
    if (format == "appended" && file.appended_is_raw) return;
    auto base64 = std::make_unique<Base64Bytes>(*inner_);
    base64_ = base64.get();
    outer_ = std::move(base64);
  }

  ByteSource& bytes() { return outer_ ? *outer_ : *inner_; }

  void begin_next_piece() {
    if (base64_ != nullptr) base64_->begin_next();
  }

  /// To be called with how many bytes the array takes before they are read. Throws gale::Error if it lies where
  /// others do: all together take more than there are.
  void claim(std::uint64_t bytes, const XmlElement& array) const {
    if (array.attribute("format") != "appended") return;
    if (bytes > file_.file.size() - file_.appended_read)
      damaged(its(array), " lies where other arrays do: all together are longer than the file");
    file_.appended_read += bytes;
  }

  std::uint64_t header_number() {
    char raw[8] = {};
    read_all(bytes(), raw, file_.header_bytes, "an array's header");
    if (file_.header_bytes == 8) return from<std::uint64_t>(raw);
    return from<std::uint32_t>(raw);
  }

 private:
  template <class T>
  T from(const char* raw) const {
    T number;
    std::memcpy(&number, raw, sizeof(T));
    to_machine_order(&number, 1, file_.order);
    return number;
  }

  const XmlFile& file_;
  std::unique_ptr<ByteSource> inner_, outer_;
  Base64Bytes* base64_ = nullptr;
};

/// The blocks that a compressed array consists of: all of `block_bytes`, but for the last.
struct Blocks {
  std::uint64_t block_bytes = 0, last_bytes = 0;
  std::vector<std::uint64_t> compressed;

  std::size_t bytes_of(std::size_t block) const {
    return static_cast<std::size_t>(block + 1 == compressed.size() && last_bytes > 0 ? last_bytes : block_bytes);
  }
  std::uint64_t bytes() const {
    if (compressed.empty()) return 0;
    return (compressed.size() - 1) * block_bytes + bytes_of(compressed.size() - 1);
  }
};

Blocks read_blocks(Binary& binary, const XmlFile& file) {
  Blocks blocks;
  const std::uint64_t count = binary.header_number();
  blocks.block_bytes = binary.header_number();
  blocks.last_bytes = binary.header_number();
  if (count > binary.bytes().at_most() / file.header_bytes) damaged("an array claims ", count, " blocks");
  if (blocks.last_bytes > blocks.block_bytes || blocks.block_bytes > (std::uint64_t(1) << 40) ||
      (count > 0 && blocks.block_bytes == 0))
    damaged("an array claims blocks of ", blocks.block_bytes, " bytes and a last one of ", blocks.last_bytes);
  std::uint64_t sum = 0;
  for (std::uint64_t k = 0; k < count; ++k) {
    blocks.compressed.push_back(binary.header_number());
    if (blocks.compressed.back() > binary.bytes().at_most()) damaged("an array's block is longer than the file");
    sum += blocks.compressed.back();
  }
  binary.begin_next_piece();
  if (sum > binary.bytes().at_most()) damaged("an array's blocks are longer than the file");
  constexpr std::uint64_t best_ratio = 8192;  // LZMA's; no block can be of more
  if (blocks.bytes() / best_ratio > sum + 1024) damaged("an array claims ", blocks.bytes(), " bytes in ", sum);
  return blocks;
}

/// Uncompresses some blocks from the first-th on, each by a thread: the k-th of them is from[k] bytes behind
/// `compressed`. Returns whether all are good.
bool uncompress_some(const Uncompress& to_bytes, const Blocks& blocks, std::size_t first, const char* compressed,
                     const std::vector<std::size_t>& from, char* to) {
  std::atomic<bool> are_good{true};
  const int threads = static_cast<int>(std::min<std::size_t>(host_threads(), from.size()));
  in_turns(threads, static_cast<std::int64_t>(from.size()), [&](int, std::int64_t k) {
    const std::size_t block = first + static_cast<std::size_t>(k);
    if (!to_bytes(compressed + from[k], blocks.compressed[block], to + k * blocks.block_bytes, blocks.bytes_of(block)))
      are_good = false;
  });
  return are_good;
}

/// Uncompresses blocks into values as they are read, some at a time: memory is taken as they arrive.
template <class T>
std::vector<T> uncompressed_values(Binary& binary, const Blocks& blocks, const XmlFile& file, std::uint64_t count) {
  constexpr std::size_t bytes_at_once = 1 << 24;
  const Uncompress to_bytes = find_uncompress(file.compressor);
  std::vector<T> values;
  values.reserve(count);
  std::vector<char> compressed;
  std::size_t done = 0;
  for (std::size_t first = 0; first < blocks.compressed.size() && done < count * sizeof(T);) {
    std::size_t last = first, bytes = 0, compressed_bytes = 0;
    std::vector<std::size_t> from;
    do {
      from.push_back(compressed_bytes);
      compressed_bytes += static_cast<std::size_t>(blocks.compressed[last]);
      bytes += blocks.bytes_of(last++);
    } while (last < blocks.compressed.size() && bytes + blocks.block_bytes <= bytes_at_once);
    compressed.resize(compressed_bytes);
    read_all(binary.bytes(), compressed.data(), compressed_bytes, "an array");
    const auto make_room = [&] {
      values.resize((done + bytes + sizeof(T) - 1) / sizeof(T));
      return reinterpret_cast<char*>(values.data()) + done;
    };
    // A very large block goes elsewhere first: what it doesn't stand for isn't touched there.
    const std::unique_ptr<char[]> apart(bytes > bytes_at_once ? new char[bytes] : nullptr);
    char* const to = apart ? apart.get() : make_room();
    if (!uncompress_some(to_bytes, blocks, first, compressed.data(), from, to))
      damaged("an array's compressed block is wrong");
    if (apart) std::memcpy(make_room(), apart.get(), bytes);
    done += bytes;
    first = last;
  }
  values.resize(count);
  to_machine_order(values.data(), values.size(), file.order);
  return values;
}

PointArray::Values read_binary(const XmlFile& file, const XmlElement& array, ValueType type,
                               std::optional<std::uint64_t> count) {
  Binary binary(file, array);
  const std::size_t size = size_of(type);
  const auto check = [&](std::uint64_t bytes) {
    if (!count) count = bytes / size;
    if (bytes / size < *count)
      damaged(its(array), " has ", bytes, " bytes, not ", *count, " values of type ", name_of(type));
  };
  if (file.compressor.empty()) {
    const std::uint64_t bytes = binary.header_number();
    if (bytes > binary.bytes().at_most()) damaged(its(array), " claims ", bytes, " bytes, more than follow");
    binary.claim(bytes, array);
    check(bytes);
    return read_values(binary.bytes(), type, *count, file.order);
  }
  const Blocks blocks = read_blocks(binary, file);
  binary.claim(std::accumulate(blocks.compressed.begin(), blocks.compressed.end(), std::uint64_t(0)), array);
  check(blocks.bytes());
  return with_type(type, [&](auto example) -> PointArray::Values {
    return uncompressed_values<decltype(example)>(binary, blocks, file, *count);
  });
}

}  // namespace

bool use_blocks(const XmlFile& file, const XmlElement& array, std::uint64_t count, const UseBlock& use) {
  const std::optional<ValueType> type = type_of(array);
  if (!type || array.attribute("format") != "appended" || !file.appended_is_raw || file.compressor.empty())
    return false;
  const std::size_t size = size_of(*type);
  Binary binary(file, array);
  const Blocks blocks = read_blocks(binary, file);
  constexpr std::uint64_t most_bytes = 1 << 24;
  const bool are_many = blocks.block_bytes <= most_bytes && blocks.block_bytes % size == 0;
  if (!are_many || blocks.bytes() != product(count, size)) return false;
  std::vector<std::uint64_t> begin = {file.file.size() - binary.bytes().at_most()};
  for (const std::uint64_t bytes : blocks.compressed) begin.push_back(begin.back() + bytes);
  binary.claim(begin.back() - begin.front(), array);
  const Uncompress to_bytes = find_uncompress(file.compressor);
  const auto all = static_cast<std::int64_t>(blocks.compressed.size());
  const auto threads = static_cast<int>(std::min<std::int64_t>(host_threads(), all));
  std::vector<std::vector<char>> compressed(threads), plain(threads);
  in_turns(threads, all, [&](int thread, std::int64_t k) {
    const std::size_t from_bytes = blocks.compressed[k], bytes = blocks.bytes_of(k);
    std::vector<char>&from = compressed[thread], &to = plain[thread];
    if (from.size() < from_bytes) from.resize(from_bytes);
    if (to.size() < bytes) to.resize(bytes);
    file.file.read(begin[k], from.data(), from_bytes);
    if (!to_bytes(from.data(), from_bytes, to.data(), bytes)) damaged("an array's compressed block is wrong");
    with_type(*type, [&](auto example) {
      to_machine_order(reinterpret_cast<decltype(example)*>(to.data()), bytes / size, file.order);
    });
    use(*type, k * blocks.block_bytes / size, to.data(), bytes / size);
  });
  return true;
}

std::string XmlElement::attribute(const std::string& key, const std::string& otherwise) const {
  const auto found = attributes.find(key);
  return found == attributes.end() ? otherwise : found->second;
}

const XmlElement* XmlElement::child(const std::string& wanted) const {
  for (const XmlElement& element : children) {
    if (element.name == wanted) return &element;
  }
  return nullptr;
}

const XmlElement& XmlElement::require(const std::string& wanted) const {
  const XmlElement* const found = child(wanted);
  if (found == nullptr) damaged("its ", name, " has no ", wanted);
  return *found;
}

std::vector<const XmlElement*> XmlElement::all(const std::string& wanted) const {
  std::vector<const XmlElement*> found;
  for (const XmlElement& element : children) {
    if (element.name == wanted) found.push_back(&element);
  }
  return found;
}

const XmlElement* XmlElement::array(const std::string& section, const std::string& wanted) const {
  const XmlElement* const arrays = child(section);
  if (arrays == nullptr) return nullptr;
  for (const XmlElement* const array : arrays->all("DataArray")) {
    if (array->attribute("Name") == wanted) return array;
  }
  return nullptr;
}

std::uint64_t XmlElement::number(const std::string& key) const {
  const auto found = attributes.find(key);
  if (found == attributes.end()) damaged("its ", name, " has no ", key);
  std::uint64_t value;
  if (!parse(found->second, value)) damaged("the ", key, " of its ", name, " is '", found->second, "'");
  return value;
}

XmlFile read_xml(const InputFile& file, const std::string& type, const std::string& cell_array) {
  XmlFile result{file, {}};
  read_tree(result, cell_array);
  const XmlElement& root = result.root;
  if (root.name != "VTKFile" || root.attribute("type") != type)
    damaged("it is no VTKFile of type ", type, " but a ", root.name, " of type '", root.attribute("type"), "'");
  const std::string order = root.attribute("byte_order");
  if (!order.empty() && order != "LittleEndian" && order != "BigEndian") damaged("its byte_order is '", order, "'");
  if (!order.empty()) result.order = order == "BigEndian" ? ByteOrder::big : ByteOrder::little;
  const std::string header = root.attribute("header_type", "UInt32");
  if (header != "UInt32" && header != "UInt64") damaged("its header_type is '", header, "'");
  result.header_bytes = header == "UInt64" ? 8 : 4;
  result.compressor = root.attribute("compressor");
  return result;
}

PointArray::Values read_array(const XmlFile& file, const XmlElement& array, std::optional<std::uint64_t> count) {
  const std::optional<ValueType> type = type_of(array);
  if (!type) damaged(its(array), " has values of type '", array.attribute("type"), "'");
  if (array.attribute("format", "ascii") != "ascii") return read_binary(file, array, *type, count);
  MemoryBytes bytes(array.text);
  TextReader text(bytes);
  return read_text_values(text, *type, count);
}

XmlArrays read_point_data(const XmlFile& file, const XmlElement& piece, std::uint64_t points) {
  XmlArrays result;
  const XmlElement* const data = piece.child("PointData");
  if (data == nullptr) return result;
  const std::string scalars = data->attribute("Scalars"), ids = data->attribute("GlobalIds");
  bool has_scalars = scalars.empty();
  for (const XmlElement& array : data->children) {
    if (array.name != "DataArray" && array.name != "Array") continue;
    const std::string name = array.attribute("Name", "scalars");
    if (!type_of(array)) {
      result.notices.push_back(note_array(name, "its values are of type " + lower_case(array.attribute("type"))));
      continue;
    }
    const bool has_components = array.attributes.count("NumberOfComponents") > 0;
    const std::uint64_t components = has_components ? array.number("NumberOfComponents") : 1;
    if (components < 1 || components > (1u << 20)) damaged(its(array), " has ", components, " components");
    const std::uint64_t count = product(points, components);
    const bool first = !has_scalars && name == scalars;
    has_scalars |= first;
    result.arrays.insert(first ? result.arrays.begin() : result.arrays.end(),
                         PointArray{name, static_cast<int>(components), read_array(file, array, count)});
  }
  const auto is_looked_at = [&](const PointArray& array) { return array.name != ids || array.name == scalars; };
  if (!ids.empty()) std::stable_partition(result.arrays.begin(), result.arrays.end(), is_looked_at);
  return result;
}

std::vector<std::string> names_of_cell_data(const XmlElement& piece) {
  std::vector<std::string> names;
  const XmlElement* const data = piece.child("CellData");
  if (data == nullptr) return names;
  for (const XmlElement& array : data->children) {
    if (array.name == "DataArray" || array.name == "Array") names.push_back(array.attribute("Name"));
  }
  return names;
}

}  // namespace gale::io::detail
