#include <charconv>
#include <cstdint>
#include <utility>

#include <gale/base/error.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/write.hpp>

namespace gale::io {

namespace {

/// The integer's bytes, the least significant first.
std::string bytes_of(std::uint64_t value, int count) {
  std::string bytes;
  for (int k = 0; k < count; ++k) bytes += static_cast<char>(value >> 8 * k & 0xff);
  return bytes;
}

/// The checksum that ZIP has, CRC-32.
std::uint32_t checksum_of(const std::string& bytes) {
  std::uint32_t of_byte[256], sum = ~0u;
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t rest = byte;
    for (int bit = 0; bit < 8; ++bit) rest = rest >> 1 ^ ((rest & 1) != 0 ? 0xedb88320 : 0);
    of_byte[byte] = rest;
  }
  for (const char c : bytes) sum = sum >> 8 ^ of_byte[(sum ^ static_cast<unsigned char>(c)) & 0xff];
  return ~sum;
}

/// A column as an array of NumPy's: format 1.0.
std::string to_npy(const PointArray& column) {
  static const char* const types[] = {"i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8"};
  const bool is_little = detail::byte_order_of_machine() == detail::ByteOrder::little;
  std::string header = std::string("{'descr': '") + (is_little ? '<' : '>') + types[column.values.index()] +
                       "', 'fortran_order': False, 'shape': (" + std::to_string(point_count(column)) + "," +
                       (column.components > 1 ? std::to_string(column.components) : "") + ")}";
  constexpr std::size_t before = 10, aligned = 64;
  header.append(aligned - 1 - (before + header.size()) % aligned, ' ');
  header += '\n';
  return std::visit(
      [&](const auto& values) {
        return "\x93NUMPY" + bytes_of(1, 2) + bytes_of(header.size(), 2) + header +
               std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0]));
      },
      column.values);
}

/// A name as a line of comma-separated values has it.
std::string quoted(const std::string& name) {
  if (name.find_first_of(",\"\r\n") == std::string::npos) return name;
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

/// Adds a number such that it is read back as it is, whatever the program's locale.
template <class T>
void add_number(T value, std::string& text) {
  char digits[32];
  constexpr int enough = 17;  // for any double
  const auto end = [&] {
    if constexpr (std::is_floating_point_v<T>) {
      return std::to_chars(digits, digits + sizeof digits, static_cast<double>(value), std::chars_format::general,
                           enough);
    } else {
      return std::to_chars(digits, digits + sizeof digits, value);
    }
  }();
  text.append(digits, end.ptr);
}

}  // namespace

std::string to_csv(const std::vector<PointArray>& columns) {
  std::string csv;
  bool is_first = true;  // in its line
  const auto separate = [&] {
    if (!std::exchange(is_first, false)) csv += ',';
  };
  const auto end_line = [&] {
    csv += '\n';
    is_first = true;
  };
  const std::size_t rows = columns.empty() ? 0 : point_count(columns.front());
  for (const PointArray& column : columns) {
    if (point_count(column) != rows)
      detail::refuse("the column '", column.name, "' has ", point_count(column), " rows, '", columns.front().name, "' ",
                     rows);
    for (int k = 0; k < column.components; ++k) {
      separate();
      csv += quoted(column.components == 1 ? column.name : column.name + "_" + std::to_string(k));
    }
  }
  end_line();
  for (std::size_t row = 0; row < rows; ++row) {
    for (const PointArray& column : columns) {
      for (int k = 0; k < column.components; ++k) {
        separate();
        std::visit([&](const auto& values) { add_number(values[row * column.components + k], csv); }, column.values);
      }
    }
    end_line();
  }
  return csv;
}

std::string to_npz(const std::vector<PointArray>& columns) {
  std::string all, directory;
  for (const PointArray& column : columns) {
    const std::string name = column.name + ".npy", array = to_npy(column);
    constexpr std::uint32_t version = 20, of_1980 = 0x21;  // as ZIP's dates begin
    const std::string alike = bytes_of(version, 2) + bytes_of(0, 6) + bytes_of(of_1980, 2) +
                              bytes_of(checksum_of(array), 4) + bytes_of(array.size(), 4) + bytes_of(array.size(), 4) +
                              bytes_of(name.size(), 2) + bytes_of(0, 2);
    directory += "PK\1\2" + bytes_of(version, 2) + alike + bytes_of(0, 10) + bytes_of(all.size(), 4) + name;
    all += "PK\3\4" + alike + name + array;
    if (all.size() >> 32 != 0) throw Error("a table of 4 GiB is too large for .npz: take .csv");
  }
  const std::string end = "PK\5\6" + bytes_of(0, 4) + bytes_of(columns.size(), 2) + bytes_of(columns.size(), 2) +
                          bytes_of(directory.size(), 4) + bytes_of(all.size(), 4) + bytes_of(0, 2);
  return all + directory + end;
}

}  // namespace gale::io
