#include <cstring>
#include <limits>
#include <map>

#include <gale/io/bytes/byte_source.hpp>
#include <gale/io/bytes/damaged.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/formats/array_file.hpp>

// NetCDF's classic forms: a header that says where each variable begins, in big-endian numbers. Variables with the
// unlimited dimension lie record by record: a row of each in turn.
namespace gale::io::detail {

namespace {

struct Variable : FileArray {
  std::uint64_t begin = 0;
  bool is_in_records = false;
  std::map<std::string, FileAttribute> attributes;

  std::uint64_t row_bytes() const { return count(1) * size_of(*type); }
};

std::uint64_t padded(std::uint64_t bytes) { return (bytes + 3) / 4 * 4; }

/// The header, as it is read.
class NetcdfHeader {
 public:
  explicit NetcdfHeader(const InputFile& file) : bytes_(file, 4) {
    char magic[4];
    file.read(0, magic, sizeof magic);
    if (magic[3] != 1 && magic[3] != 2 && magic[3] != 5)
      damaged("its version of NetCDF is " + std::to_string(static_cast<unsigned char>(magic[3])));
    count_bytes_ = magic[3] == 5 ? 8 : 4;
    offset_bytes_ = magic[3] == 1 ? 4 : 8;
  }

  std::uint64_t count() { return number(count_bytes_); }
  std::uint64_t offset() { return number(offset_bytes_); }
  std::uint64_t tag() { return number(4); }
  bool is_endless(std::uint64_t count) const {
    return count == (count_bytes_ == 8 ? ~std::uint64_t(0) : std::numeric_limits<std::uint32_t>::max());
  }

  /// How many there are in the list that comes, of things of that tag. `what` they are.
  std::uint64_t list(std::uint64_t expected, const char* what) {
    const std::uint64_t found = tag(), size = count();
    if (found == 0 && size == 0) return 0;
    if (found != expected) damaged(std::string("its ") + what + " begin with " + std::to_string(found));
    return size;
  }

  std::string text() { return std::string(characters(count())); }

  std::string characters(std::uint64_t size) {
    if (size > rest()) damaged("a name in its header is longer than the file");
    std::string result(static_cast<std::size_t>(size), '\0');
    take(result.data(), result.size());
    char padding[3];
    take(padding, static_cast<std::size_t>(padded(size) - size));
    return result;
  }

  ValueType type(bool& is_text) {
    const std::uint64_t code = tag();
    is_text = code == 2;
    static constexpr ValueType types[] = {ValueType::int8,    ValueType::int8,    ValueType::int16, ValueType::int32,
                                          ValueType::float32, ValueType::float64, ValueType::uint8, ValueType::uint16,
                                          ValueType::uint32,  ValueType::int64,   ValueType::uint64};
    if (code < 1 || code > std::size(types)) damaged("its header has a type of the number " + std::to_string(code));
    return types[code - 1];
  }

  FileAttribute attribute() {
    FileAttribute result;
    bool is_text;
    const ValueType value_type = type(is_text);
    const std::uint64_t size = count();
    if (size > rest() / size_of(value_type)) damaged("an attribute in its header is longer than the file");
    std::string raw = characters(size * size_of(value_type));
    if (is_text) {
      result.text = std::move(raw);
    } else {
      with_type(value_type, [&](auto example) {
        for (std::uint64_t k = 0; k < size; ++k) {
          auto value = example;
          std::memcpy(&value, raw.data() + k * sizeof value, sizeof value);
          to_machine_order(&value, 1, ByteOrder::big);
          result.numbers.push_back(static_cast<double>(value));
        }
      });
    }
    return result;
  }

 private:
  std::uint64_t number(int bytes) {
    unsigned char raw[8];
    take(reinterpret_cast<char*>(raw), static_cast<std::size_t>(bytes));
    std::uint64_t result = 0;
    for (int k = 0; k < bytes; ++k) result = result << 8 | raw[k];
    return result;
  }

  std::uint64_t rest() const { return bytes_.at_most() + buffer_.size() - at_; }

  /// The file is read some bytes at a time.
  void take(char* to, std::size_t bytes) {
    while (bytes > 0) {
      if (at_ == buffer_.size()) {
        buffer_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(bytes_.at_most(), 1 << 16)));
        if (buffer_.empty()) damaged("it ends in its header");
        read_all(bytes_, buffer_.data(), buffer_.size(), "its header");
        at_ = 0;
      }
      const std::size_t now = std::min(bytes, buffer_.size() - at_);
      std::memcpy(to, buffer_.data() + at_, now);
      at_ += now;
      to += now;
      bytes -= now;
    }
  }

  FileBytes bytes_;
  std::vector<char> buffer_;
  std::size_t at_ = 0;
  int count_bytes_ = 4, offset_bytes_ = 4;
};

class NetcdfFile : public ArrayFile {
 public:
  explicit NetcdfFile(const InputFile& file) : ArrayFile(file) {
    NetcdfHeader header(file);
    records_ = header.count();
    if (header.is_endless(records_)) damaged("its number of records is left open");
    read_dimensions(header);
    for (std::uint64_t rest = header.list(attributes_tag, "attributes"); rest > 0; --rest) {
      header.text();
      header.attribute();
    }
    for (std::uint64_t rest = header.list(11, "variables"); rest > 0; --rest) read_variable(header);
    std::uint64_t in_records = 0;
    for (const auto& [name, variable] : variables_) {
      if (!variable.is_in_records) continue;
      record_bytes_ = sum(record_bytes_, padded(variable.row_bytes()));
      if (++in_records == 1) alone_bytes_ = variable.row_bytes();
    }
    if (in_records == 1) record_bytes_ = alone_bytes_;  // isn't padded then
  }

  const FileArray* find(const std::string& name) const override {
    const auto found = variables_.find(name);
    return found == variables_.end() ? nullptr : &found->second;
  }

  std::optional<std::uint64_t> dimension(const std::string& name) const override {
    const auto found = lengths_.find(name);
    if (found == lengths_.end()) return std::nullopt;
    return found->second;
  }

  std::optional<FileAttribute> attribute(const std::string& array, const std::string& name) override {
    const auto& attributes = variables_.at(array).attributes;
    const auto found = attributes.find(name);
    if (found == attributes.end()) return std::nullopt;
    return found->second;
  }

 protected:
  std::uint64_t stored_bytes(const FileArray& array, std::uint64_t rows, std::uint64_t bytes) override {
    const Variable& variable = variables_.at(array.name);
    const std::uint64_t last =
        variable.is_in_records ? product_of(rows - 1, record_bytes_) + variable.row_bytes() : bytes;
    if (variable.begin > file_.size() || last > file_.size() - variable.begin) {
      damaged("its '" + array.name + "' ends at byte " + std::to_string(sum(variable.begin, last)) + " of " +
              std::to_string(file_.size()));
    }
    return bytes;
  }

  void copy(const FileArray& array, std::uint64_t rows, char* to, std::uint64_t bytes) override {
    const Variable& variable = variables_.at(array.name);
    if (!variable.is_in_records) return file_.read(variable.begin, to, bytes);
    const std::uint64_t row = variable.row_bytes();
    for (std::uint64_t k = 0; k < rows; ++k) file_.read(variable.begin + k * record_bytes_, to + k * row, row);
  }

 private:
  static constexpr std::uint64_t attributes_tag = 12;

  static std::uint64_t product_of(std::uint64_t a, std::uint64_t b) {
    return product({static_cast<std::int64_t>(a), static_cast<std::int64_t>(b)}, "an array");
  }
  static std::uint64_t sum(std::uint64_t a, std::uint64_t b) { return a > ~b ? ~std::uint64_t(0) : a + b; }

  void read_dimensions(NetcdfHeader& header) {
    for (std::uint64_t rest = header.list(10, "dimensions"); rest > 0; --rest) {
      std::string name = header.text();
      const std::uint64_t length = header.count();
      if (length > std::uint64_t(std::numeric_limits<std::int64_t>::max()))
        damaged("its dimension '" + name + "' is " + std::to_string(length));
      order_.push_back(length);
      if (!lengths_.emplace(name, length == 0 ? records_ : length).second)
        damaged("two of its dimensions are called '" + name + "'");
    }
  }

  void read_variable(NetcdfHeader& header) {
    Variable variable;
    variable.name = header.text();
    variable.order = ByteOrder::big;
    const std::uint64_t dimensions = header.count();
    if (dimensions > 1024) damaged("its '" + variable.name + "' has " + std::to_string(dimensions) + " dimensions");
    for (std::uint64_t d = 0; d < dimensions; ++d) {
      const std::uint64_t which = header.count();
      if (which >= order_.size()) damaged("its '" + variable.name + "' has a dimension that there isn't");
      const bool is_unlimited = order_[which] == 0;
      if (is_unlimited && d > 0) damaged("a dimension of its '" + variable.name + "' but the first is unlimited");
      variable.is_in_records |= is_unlimited;
      variable.shape.push_back(is_unlimited ? records_ : order_[which]);
    }
    for (std::uint64_t rest = header.list(attributes_tag, "attributes"); rest > 0; --rest) {
      std::string name = header.text();
      variable.attributes[name] = header.attribute();
    }
    variable.type = header.type(variable.is_text);
    header.count();  // its size, which follows from the above
    variable.begin = header.offset();
    product_of(variable.count(1), size_of(*variable.type));
    const std::string name = variable.name;
    if (!variables_.emplace(name, std::move(variable)).second)
      damaged("two of its variables are called '" + name + "'");
  }

  std::uint64_t records_ = 0, record_bytes_ = 0, alone_bytes_ = 0;
  std::vector<std::uint64_t> order_;  ///< the dimensions' lengths; 0 for the unlimited one
  std::map<std::string, std::uint64_t> lengths_;
  std::map<std::string, Variable> variables_;
};

bool begins_with(const InputFile& file, const std::string& magic) {
  std::string begin(magic.size(), '\0');
  if (file.size() < magic.size()) return false;
  file.read(0, begin.data(), begin.size());
  return begin == magic;
}

}  // namespace

bool is_netcdf(const InputFile& file) { return begins_with(file, "CDF"); }
bool is_hdf5(const InputFile& file) { return begins_with(file, "\x89HDF\r\n\x1a\n"); }

std::unique_ptr<ArrayFile> open_netcdf(const InputFile& file) { return std::make_unique<NetcdfFile>(file); }

}  // namespace gale::io::detail
