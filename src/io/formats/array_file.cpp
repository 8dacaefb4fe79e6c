#include <cstring>
#include <limits>
#include <map>

#include <gale/io/bytes/input_file.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/formats/array_file.hpp>

namespace gale::io::detail {

std::uint64_t FileArray::count(std::uint64_t rows) const {
  std::uint64_t count = rows;
  for (std::size_t d = 1; d < shape.size(); ++d) count = product(count, shape[d]);
  return count;
}

const FileArray& ArrayFile::require(const std::string& name) const {
  const FileArray* const array = find(name);
  if (array == nullptr) damaged("it has no '", name, "'");
  if (!array->type) damaged("its '", name, "' has no numbers");
  return *array;
}

PointArray::Values ArrayFile::read(const FileArray& array, Rows rows) {
  if (rows.count > array.rows() || rows.first > array.rows() - rows.count)
    damaged("its '", array.name, "' has ", array.rows(), " rows, not ", rows.count, " from ", rows.first, " on");
  return with_type(array.type.value(), [&](auto example) -> PointArray::Values {
    using T = decltype(example);
    const std::uint64_t count = array.count(rows.count), bytes = product(count, sizeof(T));
    if (count == 0) return std::vector<T>();
    const std::uint64_t stored = stored_bytes(array, rows, bytes);
    if (stored > file_.size() - read_bytes_)
      damaged("its '", array.name, "' lies where other arrays do: all together are longer than the file");
    read_bytes_ += stored;
    std::vector<T> values(count);
    copy(array, rows, reinterpret_cast<char*>(values.data()), bytes);
    to_machine_order(values.data(), values.size(), array.order);
    return values;
  });
}

// NetCDF's classic forms: a header that says where each variable begins, in big-endian numbers. Variables with the
// unlimited dimension lie record by record: a row of each in turn.
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
  explicit NetcdfHeader(const InputFile& file) : bytes_(file, 4), buffered_(bytes_) {
    char magic[4];
    file.read(0, magic, sizeof magic);
    if (magic[3] != 1 && magic[3] != 2 && magic[3] != 5)
      damaged("its version of NetCDF is ", static_cast<unsigned char>(magic[3]));
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
    if (found != expected) damaged("its ", what, " begin with ", found);
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
    if (code < 1 || code > std::size(types)) damaged("its header has a type of the number ", code);
    return types[code - 1];
  }

  FileAttribute attribute() {
    FileAttribute result;
    bool is_text;
    const ValueType value_type = type(is_text);
    const std::uint64_t size = count();
    if (size > rest() / size_of(value_type)) damaged("an attribute in its header is longer than the file");
    const std::string raw = characters(size * size_of(value_type));
    if (is_text) result.text = raw;
    if (is_text) return result;
    MemoryBytes bytes(raw);
    std::visit([&](const auto& values) { result.numbers.assign(values.begin(), values.end()); },
               read_values(bytes, value_type, size, ByteOrder::big));
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

  std::uint64_t rest() const { return buffered_.at_most(); }
  void take(char* to, std::size_t bytes) {
    if (bytes > rest()) damaged("it ends in its header");
    read_all(buffered_, to, bytes, "its header");
  }

  FileBytes bytes_;
  TextReader buffered_;
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
  std::uint64_t stored_bytes(const FileArray& array, Rows rows, std::uint64_t bytes) override {
    const Variable& variable = variables_.at(array.name);
    const std::uint64_t last =
        sum(product(rows.first + rows.count - 1, variable.is_in_records ? record_bytes_ : variable.row_bytes()),
            variable.row_bytes());
    if (variable.begin > file_.size() || last > file_.size() - variable.begin)
      damaged("its '", array.name, "' ends at byte ", sum(variable.begin, last), " of ", file_.size());
    return bytes;
  }

  void copy(const FileArray& array, Rows rows, char* to, std::uint64_t bytes) override {
    const Variable& variable = variables_.at(array.name);
    const std::uint64_t row = variable.row_bytes();
    if (!variable.is_in_records) return file_.read(variable.begin + rows.first * row, to, bytes);
    for (std::uint64_t k = 0; k < rows.count; ++k)
      file_.read(variable.begin + (rows.first + k) * record_bytes_, to + k * row, row);
  }

 private:
  static constexpr std::uint64_t attributes_tag = 12;

  static std::uint64_t sum(std::uint64_t a, std::uint64_t b) { return a > ~b ? ~std::uint64_t(0) : a + b; }

  void read_dimensions(NetcdfHeader& header) {
    for (std::uint64_t rest = header.list(10, "dimensions"); rest > 0; --rest) {
      std::string name = header.text();
      const std::uint64_t length = header.count();
      if (length > std::uint64_t(std::numeric_limits<std::int64_t>::max()))
        damaged("its dimension '", name, "' is ", length);
      order_.push_back(length);
      if (!lengths_.emplace(name, length == 0 ? records_ : length).second)
        damaged("two of its dimensions are called '", name, "'");
    }
  }

  void read_variable(NetcdfHeader& header) {
    Variable variable;
    variable.name = header.text();
    variable.order = ByteOrder::big;
    const std::uint64_t dimensions = header.count();
    if (dimensions > 1024) damaged("its '", variable.name, "' has ", dimensions, " dimensions");
    for (std::uint64_t d = 0; d < dimensions; ++d) {
      const std::uint64_t which = header.count();
      if (which >= order_.size()) damaged("its '", variable.name, "' has a dimension that there isn't");
      const bool is_unlimited = order_[which] == 0;
      if (is_unlimited && d > 0) damaged("a dimension of its '", variable.name, "' but the first is unlimited");
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
    product(variable.count(1), size_of(*variable.type));
    const std::string name = variable.name;
    if (!variables_.emplace(name, std::move(variable)).second) damaged("two of its variables are called '", name, "'");
  }

  std::uint64_t records_ = 0, record_bytes_ = 0, alone_bytes_ = 0;
  std::vector<std::uint64_t> order_;  ///< the dimensions' lengths; 0 for the unlimited one
  std::map<std::string, std::uint64_t> lengths_;
  std::map<std::string, Variable> variables_;
};

}  // namespace

std::unique_ptr<ArrayFile> open_netcdf(const InputFile& file) { return std::make_unique<NetcdfFile>(file); }

}  // namespace gale::io::detail
