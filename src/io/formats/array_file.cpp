#include <gale/io/bytes/damaged.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/formats/array_file.hpp>

namespace gale::io::detail {

std::uint64_t FileArray::count(std::uint64_t rows) const {
  std::uint64_t count = rows;
  for (std::size_t d = 1; d < shape.size(); ++d)
    count = product({static_cast<std::int64_t>(count), static_cast<std::int64_t>(shape[d])}, "an array");
  return count;
}

const FileArray& ArrayFile::require(const std::string& name) const {
  const FileArray* const array = find(name);
  if (array == nullptr) damaged("it has no '" + name + "'");
  if (!array->type) damaged("its '" + name + "' has no numbers");
  return *array;
}

PointArray::Values ArrayFile::read(const FileArray& array, std::uint64_t rows) {
  if (rows > array.rows()) {
    damaged("its '" + array.name + "' has " + std::to_string(array.rows()) + " rows, not " + std::to_string(rows));
  }
  return with_type(array.type.value(), [&](auto example) -> PointArray::Values {
    using T = decltype(example);
    const auto size = static_cast<std::int64_t>(sizeof(T));
    const std::uint64_t count = array.count(rows),
                        bytes = product({static_cast<std::int64_t>(count), size}, "an array");
    if (count == 0) return std::vector<T>();
    const std::uint64_t stored = stored_bytes(array, rows, bytes);
    if (stored > file_.size() - read_bytes_) {
      damaged("its '" + array.name + "' lies where other arrays do: all together are longer than the file");
    }
    read_bytes_ += stored;
    std::vector<T> values(count);
    copy(array, rows, reinterpret_cast<char*>(values.data()), bytes);
    to_machine_order(values.data(), values.size(), array.order);
    return values;
  });
}

}  // namespace gale::io::detail
