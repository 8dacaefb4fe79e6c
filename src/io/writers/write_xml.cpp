#include <algorithm>

#include <gale/base/threads.hpp>
#include <gale/io/bytes/byte_order.hpp>
#include <gale/io/bytes/encoded_bytes.hpp>
#include <gale/io/bytes/zlib.hpp>
#include <gale/io/writers/write_xml.hpp>
#include <gale/io/writers/xml_text.hpp>

namespace gale::io::detail {

namespace {

constexpr std::uint64_t block_bytes = 1 << 18;

/// As VTK has them: how many blocks, the bytes of a block, and of the last where that is another number, and the bytes
/// of each when it is compressed; then the blocks.
class CompressedBlocks {
 public:
  explicit CompressedBlocks(const WrittenArray& array)
      : array_(array), block_(block_bytes / size_of(array.type)), blocks_((array.count + block_ - 1) / block_) {}

  void write(OutputFile& file, Encoding encoding) const {
    std::vector<std::uint64_t> header = {blocks_, block_bytes, array_.count % block_ * size_of(array_.type)};
    const std::size_t sizes = header.size();
    header.resize(sizes + blocks_);
    const auto write_header = [&](const auto& write) {
      const std::vector<char> bytes = encoded(header.data(), header.size() * sizeof(header[0]), encoding);
      write(bytes.data(), bytes.size());
    };
    const std::uint64_t at = file.size();
    write_header([&](const char* bytes, std::size_t size) { file.write(bytes, size); });
    EncodedBytes blocks(file, encoding);
    const auto threads = static_cast<int>(std::min<std::uint64_t>(host_threads(), blocks_));
    const auto at_once = static_cast<std::size_t>(4 * threads);
    std::vector<std::vector<char>> plain(threads), compressed(at_once);
    for (std::uint64_t first = 0; first < blocks_; first += at_once) {
      const std::uint64_t count = std::min<std::uint64_t>(at_once, blocks_ - first);
      in_turns(threads, static_cast<std::int64_t>(count),
               [&](int thread, std::int64_t i) { compress(first + i, plain[thread], compressed[i]); });
      for (std::uint64_t i = 0; i < count; ++i) {
        header[sizes + first + i] = compressed[i].size();
        blocks.write(compressed[i].data(), compressed[i].size());
      }
    }
    blocks.end();
    write_header([&](const char* bytes, std::size_t size) { file.rewrite(at, bytes, size); });
  }

 private:
  void compress(std::uint64_t block, std::vector<char>& plain, std::vector<char>& compressed) const {
    const std::uint64_t begin = block * block_, end = std::min(begin + block_, array_.count);
    plain.resize((end - begin) * size_of(array_.type));
    array_.copy(begin, end, plain.data());
    compress_by_zlib(plain.data(), plain.size(), compressed);
  }

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
  if (has_zlib()) {
    CompressedBlocks(array).write(file, encoding);
  } else {
    write_plain(file, array, encoding);
  }
}

/// Up to its format.
std::string begin_of(const WrittenArray& array) {
  return "        <DataArray" + xml_attribute("type", xml_name_of(array.type)) + xml_attribute("Name", array.name) +
         xml_attribute("NumberOfComponents", std::to_string(array.components));
}

/// The arrays' elements first, then all values.
class AppendedArrays {
 public:
  explicit AppendedArrays(OutputFile& file) : file_(file) {}

  void add(const WrittenArray& array) {
    const std::string blank(21, ' ');  // for any offset and a quote: it is known when what comes before is compressed
    file_.write(begin_of(array) + xml_attribute("format", "appended") + " offset=\"");
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
  file.write(begin_of(array) + xml_attribute("format", "binary") + ">\n");
  write_values(file, array, Encoding::base64);
  file.write("\n        </DataArray>\n");
}

}  // namespace

std::string global_ids_attribute(const std::string& name) {
  return name.empty() ? "" : xml_attribute("GlobalIds", name);
}

void write_xml(const AtomicFile& to, const XmlContent& content) {
  OutputFile file(to.temporary());
  const std::string order = byte_order_of_machine() == ByteOrder::little ? "LittleEndian" : "BigEndian";
  file.write("<VTKFile" + xml_attribute("type", content.type) + xml_attribute("version", "1.0") +
             xml_attribute("byte_order", order) + xml_attribute("header_type", "UInt64") +
             (has_zlib() ? xml_attribute("compressor", "vtkZLibDataCompressor") : "") + ">\n");
  file.write("  <" + content.type + ">\n    <Piece");
  for (const auto& [name, size] : content.sizes) file.write(xml_attribute(name, std::to_string(size)));
  file.write(">\n");
  const bool appended = to.encoding() == Encoding::appended;
  AppendedArrays arrays(file);
  for (const auto& section : content.sections) {
    file.write("      <" + section.name + global_ids_attribute(section.global_ids) + ">\n");
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

}  // namespace gale::io::detail
