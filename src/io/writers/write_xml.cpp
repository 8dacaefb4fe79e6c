#include <algorithm>
#include <charconv>
#include <cstddef>
#include <string_view>

#include <gale/io/bytes/base64.hpp>
#include <gale/io/bytes/output_file.hpp>
#include <gale/io/formats.hpp>
#include <gale/io/writers/compress_blocks.hpp>

namespace gale::io::detail {
namespace {

unsigned byte(const std::string& text, std::size_t at) {
  return at < text.size() ? static_cast<unsigned char>(text[at]) : 0;
}

/// The bytes of the character of UTF-8 that begins there; 0 if none does, or none that XML may have.
std::size_t utf8_size(const std::string& text, std::size_t at) {
  const unsigned first = byte(text, at);
  if (first >> 6 == 2) return 0;
  const std::size_t size = first < 0x80 ? 1 : first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  unsigned code = size == 1 ? first : first & (0xff >> (size + 1));
  for (std::size_t k = 1; k < size; ++k) {
    if (byte(text, at + k) >> 6 != 2) return 0;
    code = code << 6 | (byte(text, at + k) & 0x3f);
  }
  constexpr unsigned least[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_no_character = code > 0x10ffff || (code >= 0xd800 && code < 0xe000) || code == 0xfffe || code == 0xffff;
  return first >= 0xf8 || code < least[size] || is_no_character ? 0 : size;
}

bool is_utf8(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t size = utf8_size(text, at);
    if (size == 0) return false;
    at += size;
  }
  return true;
}

/// The text as the value of an attribute in XML of UTF-8. Text that isn't UTF-8 is taken for Latin-1; control
/// characters, which XML has none of, become '?'.
std::string xml_text(const std::string& text) {
  const bool latin1 = !is_utf8(text);
  std::string escaped;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    const bool is_space = c == '\t' || c == '\n' || c == '\r';
    if (c == '&' || c == '<' || c == '>' || c == '"' || c == '\'' || is_space || (latin1 && code >= 0x80)) {
      escaped += "&#" + std::to_string(code) + ";";
    } else {
      escaped += code < 0x20 ? '?' : c;
    }
  }
  return escaped;
}

/// Makes ' name="value"', with such text.
std::string xml_attribute(std::string_view name, std::string_view value) {
  return text_of(" ", name, "=\"", xml_text(std::string(value)), "\"");
}

/// Compressed values as VTK has them: how many blocks, the bytes of a block, and of the last where that is another
/// number, and the bytes of each when it is compressed; then the blocks.
class CompressedBlocks {
 public:
  explicit CompressedBlocks(const WrittenArray& array)
      : array_(array), block_(block_bytes / size_of(array.type)), blocks_((array.count + block_ - 1) / block_) {}

  void write(OutputFile& file, Encoding encoding) const {
    std::vector<std::uint64_t> header = {blocks_, block_bytes, array_.count % block_ * size_of(array_.type)};
    const std::size_t sizes = header.size();
    header.resize(sizes + blocks_);
    const auto write_header = [&](const auto& write) {
      const std::vector<char> bytes = encode_bytes(header.data(), header.size() * sizeof(header[0]), encoding);
      write(bytes.data(), bytes.size());
    };
    const std::uint64_t at = file.size();
    write_header([&](const char* bytes, std::size_t size) { file.write(bytes, size); });
    EncodedBytes blocks(file, encoding);
    compress_blocks(array_, block_, false, [&](std::int64_t i, const std::vector<char>& compressed) {
      header[sizes + i] = compressed.size();
      blocks.write(compressed.data(), compressed.size());
    });
    blocks.end();
    write_header([&](const char* bytes, std::size_t size) { file.rewrite(at, bytes, size); });
  }

 private:
  const WrittenArray& array_;
  const std::uint64_t block_, blocks_;  ///< values of a block, blocks of the array
};

void write_plain(OutputFile& file, const WrittenArray& array, Encoding encoding) {
  const std::uint64_t bytes = array.count * size_of(array.type), block = block_bytes / size_of(array.type);
  EncodedBytes values(file, encoding);
  values.write(&bytes, sizeof bytes);
  std::vector<char> plain(std::min(bytes, block_bytes));
  for (std::uint64_t begin = 0; begin < array.count; begin += block) {
    const std::uint64_t end = std::min(begin + block, array.count);
    array.copy(begin, end, plain.data());
    values.write(plain.data(), (end - begin) * size_of(array.type));
  }
  values.end();
}

void write_values(OutputFile& file, const WrittenArray& array, Encoding encoding) {
  if (can_compress()) {
    CompressedBlocks(array).write(file, encoding);
  } else {
    write_plain(file, array, encoding);
  }
}

/// An array's element up to its format.
std::string begin_of(const std::string& element, const WrittenArray& array) {
  return element + xml_attribute("type", name_in(xml_types, array.type)) + xml_attribute("Name", array.name) +
         xml_attribute("NumberOfComponents", std::to_string(array.components));
}

/// A section's element; pieces' sections and those of what they have in common say alike which array has global ids.
std::string begin_of(const std::string& element, const XmlContent::Section& section) {
  return element + section.name + (section.global_ids.empty() ? "" : xml_attribute("GlobalIds", section.global_ids)) +
         ">\n";
}

/// A file's first element and its second, up to what else that says.
std::string begin_of_file(const std::string& type, const std::string& more_attributes) {
  const std::string order = byte_order_of_machine() == ByteOrder::little ? "LittleEndian" : "BigEndian";
  return "<VTKFile" + xml_attribute("type", type) + xml_attribute("version", "1.0") +
         xml_attribute("byte_order", order) + more_attributes + ">\n  <" + type;
}

/// The arrays' elements first, then all values.
class AppendedArrays {
 public:
  explicit AppendedArrays(OutputFile& file) : file_(file) {}

  void add(const WrittenArray& array) {
    const std::string blank(21, ' ');  // for any offset and a quote: it is known when what comes before is compressed
    file_.write(begin_of("        <DataArray", array) + xml_attribute("format", "appended") + " offset=\"");
    offsets_at_.push_back({&array, file_.size()});
    file_.write(blank + "/>\n");
  }

  void write() {
    file_.write("  <AppendedData encoding=\"raw\">\n   _");
    const std::uint64_t begin = file_.size();
    for (const auto& [array, offset_at] : offsets_at_) {
      const std::string offset = std::to_string(file_.size() - begin) + "\"";
      write_values(file_, *array, Encoding::appended);
      file_.rewrite(offset_at, offset.data(), offset.size());
    }
    file_.write("\n  </AppendedData>\n");
  }

 private:
  OutputFile& file_;
  std::vector<std::pair<const WrittenArray*, std::uint64_t>> offsets_at_;
};

void write_in_place(OutputFile& file, const WrittenArray& array) {
  file.write(begin_of("        <DataArray", array) + xml_attribute("format", "binary") + ">\n");
  write_values(file, array, Encoding::base64);
  file.write("\n        </DataArray>\n");
}

}  // namespace

void write_xml(const AtomicFile& to, const XmlContent& content) {
  OutputFile file(to.temporary());
  file.write(
      begin_of_file(content.type, xml_attribute("header_type", "UInt64") +
                                      (can_compress() ? xml_attribute("compressor", "vtkZLibDataCompressor") : "")) +
      ">\n    <Piece");
  for (const auto& [name, size] : content.sizes) file.write(xml_attribute(name, std::to_string(size)));
  file.write(">\n");
  const bool appended = to.encoding() == Encoding::appended;
  AppendedArrays arrays(file);
  for (const auto& section : content.sections) {
    file.write(begin_of("      <", section));
    for (const WrittenArray& array : section.arrays) {
      if (appended) {
        arrays.add(array);
      } else {
        write_in_place(file, array);
      }
    }
    file.write("      </" + section.name + ">\n");
  }
  file.write("    </Piece>\n  </" + content.type + ">\n");
  if (appended) arrays.write();
  file.write("</VTKFile>\n");
  file.flush();
}

void write_xml_pieces(const AtomicFile& to, const std::vector<std::string>& pieces, const XmlContent& like) {
  const std::string type = "P" + like.type;
  OutputFile file(to.temporary());
  file.write(begin_of_file(type, "") + xml_attribute("GhostLevel", "0") + ">\n");
  for (const auto& section : like.sections) {
    const bool is_in_pieces = section.name == "PointData" || section.name == "Points" ||
                              (section.name == "CellData" && !section.arrays.empty());
    if (!is_in_pieces) continue;
    file.write(begin_of("    <P", section));
    for (const WrittenArray& array : section.arrays) file.write(begin_of("      <PDataArray", array) + "/>\n");
    file.write("    </P" + section.name + ">\n");
  }
  for (const std::string& piece : pieces) file.write("    <Piece" + xml_attribute("Source", piece) + "/>\n");
  file.write("  </" + type + ">\n</VTKFile>\n");
  file.flush();
}

void write_xml_series(const AtomicFile& to, const std::vector<Step>& steps) {
  OutputFile file(to.temporary());
  file.write(begin_of_file("Collection", "") + ">\n");
  for (const Step& step : steps) {
    char time[32];
    const auto end = std::to_chars(time, time + sizeof time, step.time).ptr;
    file.write("    <DataSet" + xml_attribute("timestep", std::string(time, end)) + xml_attribute("part", "0") +
               xml_attribute("file", step.file) + "/>\n");
  }
  file.write("  </Collection>\n</VTKFile>\n");
  file.flush();
}

}  // namespace gale::io::detail
