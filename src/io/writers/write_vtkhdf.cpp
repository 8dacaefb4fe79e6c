#include <algorithm>
#include <array>
#include <initializer_list>

#include <gale/base/error.hpp>
#include <gale/io/bytes/output_file.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/writers/compress_blocks.hpp>

// HDF5 as its File Format Specification (version 3.0) has it: a superblock of version 2, object headers of version 2,
// groups whose links are in their headers, arrays in one piece or in deflated chunks that a fixed array lists.
namespace gale::io::detail {
namespace {

constexpr std::uint64_t undefined = ~std::uint64_t(0);

/// Bytes of the file's structure: integers of some bytes each, the least significant first.
class StructureBytes {
 public:
  StructureBytes& put(std::uint64_t value, unsigned bytes) {
    for (unsigned k = 0; k < bytes; ++k) bytes_ += static_cast<char>(value >> 8 * k & 0xff);
    return *this;
  }
  StructureBytes& put(std::initializer_list<unsigned> bytes) {
    for (const unsigned byte : bytes) put(byte, 1);
    return *this;
  }
  StructureBytes& put(const std::string& bytes) {
    bytes_ += bytes;
    return *this;
  }

  /// Puts the checksum of all before, Bob Jenkins' lookup3.
  StructureBytes& put_checksum();

  const std::string& all() const { return bytes_; }

 private:
  std::string bytes_;
};

StructureBytes& StructureBytes::put_checksum() {
  const auto turned = [](std::uint32_t x, unsigned bits) { return x << bits | x >> (32 - bits); };
  std::uint32_t a, b, c;
  a = b = c = 0xdeadbeef + static_cast<std::uint32_t>(bytes_.size());
  std::size_t at = 0;
  const auto add = [&](std::uint32_t& to) {
    for (unsigned k = 0; k < 4 && at < bytes_.size(); ++k, ++at)
      to += std::uint32_t(static_cast<unsigned char>(bytes_[at])) << 8 * k;
  };
  while (bytes_.size() - at > 12) {
    add(a), add(b), add(c);
    a -= c, a ^= turned(c, 4), c += b;
    b -= a, b ^= turned(a, 6), a += c;
    c -= b, c ^= turned(b, 8), b += a;
    a -= c, a ^= turned(c, 16), c += b;
    b -= a, b ^= turned(a, 19), a += c;
    c -= b, c ^= turned(b, 4), b += a;
  }
  add(a), add(b), add(c);
  c ^= b, c -= turned(b, 14);
  a ^= c, a -= turned(c, 11);
  b ^= a, b -= turned(a, 25);
  c ^= b, c -= turned(b, 16);
  a ^= c, a -= turned(c, 4);
  b ^= a, b -= turned(a, 14);
  c ^= b, c -= turned(b, 24);
  return put(c, 4);
}

using Shape = std::vector<std::uint64_t>;

std::string shape_message(const Shape& shape) {
  StructureBytes bytes;
  bytes.put({2, static_cast<unsigned>(shape.size()), 0, 1});
  for (const std::uint64_t n : shape) bytes.put(n, 8);
  return bytes.all();
}

/// The type of values, in this machine's order of bytes.
std::string type_message(ValueType type) {
  const auto size = static_cast<unsigned>(size_of(type)), bits = 8 * size;
  const unsigned order = byte_order_of_machine() == ByteOrder::big;
  StructureBytes bytes;
  const bool is_float = type == ValueType::float32 || type == ValueType::float64;
  if (!is_float) {
    const unsigned is_signed = with_type(type, [](auto value) { return std::is_signed_v<decltype(value)>; });
    return bytes.put({0x10, order | is_signed << 3, 0, 0}).put(size, 4).put(0, 2).put(bits, 2).all();
  }
  const unsigned exponent = size == 4 ? 8 : 11, mantissa = bits - 1 - exponent;
  bytes.put({0x11, order | 0x20, bits - 1, 0}).put(size, 4).put(0, 2).put(bits, 2);
  return bytes.put({mantissa, exponent, 0, mantissa}).put((1u << (exponent - 1)) - 1, 4).all();
}

enum Message : unsigned {
  of_shape = 1,
  of_links = 2,
  of_type = 3,
  of_fill_value = 5,
  of_link = 6,
  of_layout = 8,
  of_group = 10,
  of_filters = 11,
  of_attribute = 12
};

class Hdf5Writer {
 public:
  explicit Hdf5Writer(const std::string& path) : file_(path) { file_.write(std::string(superblock_bytes, '\0')); }

  /// Where something is in the file.
  using Address = std::uint64_t;

  /// Writes an array and what describes it.
  Address add(const WrittenArray& array) {
    const auto components = static_cast<std::uint64_t>(array.components);
    Shape shape{array.count / components};
    if (components > 1) shape.push_back(components);
    const std::uint64_t size = size_of(array.type);
    Messages messages{{of_shape, shape_message(shape)},
                      {of_type, type_message(array.type)},
                      {of_fill_value, StructureBytes().put({3, 0xb}).all()}};
    Shape chunk = shape;
    chunk[0] = std::clamp<std::uint64_t>(block_bytes / size / components, 1, std::max<std::uint64_t>(1, shape[0]));
    constexpr std::uint64_t worth_a_list = 4096;
    if (can_compress() && array.count * size >= worth_a_list) {
      messages.push_back({of_layout, chunks(array, chunk)});
      messages.push_back({of_filters, StructureBytes().put({2, 1}).put(1, 2).put(0, 2).put(1, 2).put(6, 4).all()});
    } else {
      messages.push_back({of_layout, one_piece(array)});
    }
    return write_header(messages);
  }

  /// What is in a group, by name, and its attributes.
  using Links = std::vector<std::pair<std::string, Address>>;

  Address add_group(const Links& links, const std::vector<std::string>& attributes = {}) {
    Messages messages{{of_links, StructureBytes().put({0, 0}).put(undefined, 8).put(undefined, 8).all()},
                      {of_group, std::string(2, '\0')}};
    for (const std::string& attribute : attributes) messages.push_back({of_attribute, attribute});
    for (const auto& [name, address] : links) {
      constexpr std::size_t most = 60000;  // a message has 65,535 bytes
      if (name.find('/') != std::string::npos || name == "." || name.size() > most)
        refuse("HDF5 has no array that is called '", name.substr(0, 200), "'");
      constexpr unsigned long_name = 1, of_charset = 1 << 4, utf8 = 1;
      StructureBytes bytes;
      bytes.put({1, long_name | of_charset, utf8}).put(name.size(), 2).put(name).put(address, 8);
      messages.push_back({of_link, bytes.all()});
    }
    return write_header(messages);
  }

  static std::string attribute(const std::string& name, const std::string& type, const std::string& shape,
                               const std::string& values) {
    StructureBytes bytes;
    bytes.put({3, 0}).put(name.size() + 1, 2).put(type.size(), 2).put(shape.size(), 2).put({0}).put(name).put({0});
    return bytes.put(type).put(shape).put(values).all();
  }

  /// To be called at the end, with the group of all.
  void end(Address root) {
    StructureBytes bytes;
    bytes.put("\x89HDF\r\n\x1a\n").put({2, 8, 8, 0}).put(0, 8).put(undefined, 8).put(file_.size(), 8).put(root, 8);
    bytes.put_checksum();
    file_.rewrite(0, bytes.all().data(), bytes.all().size());
    file_.flush();
  }

 private:
  static constexpr std::size_t superblock_bytes = 48;
  using Messages = std::vector<std::pair<Message, std::string>>;

  Address write(const StructureBytes& bytes) {
    const Address at = file_.size();
    file_.write(bytes.all());
    return at;
  }

  Address write_header(const Messages& messages) {
    StructureBytes inside, header;
    for (const auto& [type, bytes] : messages) inside.put(type, 1).put(bytes.size(), 2).put({0}).put(bytes);
    constexpr unsigned size_of_four_bytes = 2;
    header.put("OHDR").put({2, size_of_four_bytes}).put(inside.all().size(), 4).put(inside.all());
    return write(header.put_checksum());
  }

  /// Writes the values as they are; the layout.
  std::string one_piece(const WrittenArray& array) {
    const std::uint64_t size = size_of(array.type), block = block_bytes / size, at = file_.size();
    std::vector<char> plain(std::min(array.count, block) * size);
    for (std::uint64_t begin = 0; begin < array.count; begin += block) {
      const std::uint64_t end = std::min(begin + block, array.count);
      array.copy(begin, end, plain.data());
      file_.write(plain.data(), (end - begin) * size);
    }
    return StructureBytes().put({3, 1}).put(array.count == 0 ? undefined : at, 8).put(array.count * size, 8).all();
  }

  /// Writes chunks of that shape, compressed, and where each is; the layout.
  std::string chunks(const WrittenArray& array, const Shape& chunk) {
    const std::uint64_t size = size_of(array.type);
    std::uint64_t block = 1;
    for (const std::uint64_t n : chunk) block *= n;
    unsigned log2 = 0, page_bits = 10;
    while (block * size >> log2 > 1) ++log2;
    const unsigned size_bytes = 1 + (log2 + 8) / 8;  // as the library has it
    StructureBytes list;
    std::uint64_t count = 0;
    compress_blocks(array, block, true, [&](std::int64_t, const std::vector<char>& compressed) {
      list.put(file_.size(), 8).put(compressed.size(), size_bytes).put(0, 4);
      file_.write(compressed.data(), compressed.size());
      ++count;
    });
    while (count >> page_bits != 0) ++page_bits;  // so that the list has no pages
    constexpr unsigned of_filtered = 1, header_bytes = 28;
    const unsigned entry_bytes = 8 + size_bytes + 4;
    const Address at = file_.size();
    StructureBytes header, entries;
    header.put("FAHD").put({0, of_filtered, entry_bytes, page_bits}).put(count, 8).put(at + header_bytes, 8);
    write(header.put_checksum());
    write(entries.put("FADB").put({0, of_filtered}).put(at, 8).put(list.all()).put_checksum());
    constexpr unsigned chunked = 2, fixed_array = 3;
    Shape numbers = chunk;
    numbers.push_back(size);
    const std::uint64_t greatest = *std::max_element(numbers.begin(), numbers.end());
    unsigned number_bytes = 1;
    while (greatest >> 8 * number_bytes != 0) ++number_bytes;  // HDF5 takes no more
    StructureBytes layout;
    layout.put({4, chunked, 0, static_cast<unsigned>(numbers.size()), number_bytes});
    for (const std::uint64_t n : numbers) layout.put(n, number_bytes);
    return layout.put({fixed_array, page_bits}).put(at, 8).all();
  }

  OutputFile file_;
};

using Links = Hdf5Writer::Links;

WrittenArray number(const std::string& name, std::uint64_t value) {
  return made<std::int64_t>(name, 1, [value](std::uint64_t) { return value; });
}

/// Where each cell begins, and the last one ends: a zero before where each ends.
WrittenArray with_zero(const WrittenArray& ends) {
  return {ends.name, 1, ends.type, ends.count + 1, [&ends](std::uint64_t begin, std::uint64_t end, char* to) {
            if (begin == end) return;
            const std::size_t size = size_of(ends.type);
            if (begin == 0) std::memset(to, 0, size);
            if (end > 1) ends.copy(std::max<std::uint64_t>(begin, 1) - 1, end - 1, to + (begin == 0 ? size : 0));
          }};
}

/// Adds the arrays that say what points cells have.
void add_cells(Hdf5Writer& file, const WrittenArrays& cells, Links& to) {
  const WrittenArray &points = cells[0], &ends = cells[1];
  for (const WrittenArray& array :
       {number("NumberOfCells", ends.count), number("NumberOfConnectivityIds", points.count)})
    to.emplace_back(array.name, file.add(array));
  to.emplace_back("Connectivity", file.add(points));
  to.emplace_back("Offsets", file.add(with_zero(ends)));
  for (std::size_t k = 2; k < cells.size(); ++k) to.emplace_back("Types", file.add(cells[k]));
}

}  // namespace

void write_vtkhdf(const AtomicFile& to, const XmlContent& content) {
  static const std::pair<const char*, const char*> names_of_cells[] = {
      {"Verts", "Vertices"}, {"Lines", "Lines"}, {"Strips", "Strips"}, {"Polys", "Polygons"}};
  const bool is_surface = content.type == "PolyData";
  Hdf5Writer file(to.temporary());
  Links links;
  for (const XmlContent::Section& section : content.sections) {
    if (section.name == "Points") {
      const WrittenArray& points = section.arrays.front();
      links.emplace_back("NumberOfPoints", file.add(number("", points.count / 3)));
      links.emplace_back("Points", file.add(points));
    } else if (section.name == "Cells") {
      add_cells(file, section.arrays, links);
    } else if (section.name == "PointData" || section.name == "CellData") {
      Links arrays;
      for (const WrittenArray& array : section.arrays) arrays.emplace_back(array.name, file.add(array));
      links.emplace_back(section.name, file.add_group(arrays));
    } else {
      const auto name = std::find_if(std::begin(names_of_cells), std::end(names_of_cells),
                                     [&](const auto& names) { return names.first == section.name; });
      Links cells;
      add_cells(file, section.arrays, cells);
      links.emplace_back(name->second, file.add_group(cells));
    }
  }
  const std::string size_of_type = StructureBytes().put(content.type.size(), 4).all();
  constexpr unsigned text = 0x13, padded_by_zeros = 1;
  const std::uint64_t version[] = {is_surface ? 2u : 1u, 0};  // surfaces are of the second version
  StructureBytes numbers;
  for (const std::uint64_t n : version) numbers.put(n, 8);
  const std::string little_int64 = StructureBytes().put({0x10, 8, 0, 0}).put(8, 4).put(0, 2).put(64, 2).all();
  const auto all = file.add_group(
      links, {Hdf5Writer::attribute("Version", little_int64, shape_message({2}), numbers.all()),
              Hdf5Writer::attribute("Type", StructureBytes().put({text, padded_by_zeros, 0, 0}).put(size_of_type).all(),
                                    StructureBytes().put({2, 0, 0, 0}).all(), content.type)});
  file.end(file.add_group({{"VTKHDF", all}}));
}

}  // namespace gale::io::detail
