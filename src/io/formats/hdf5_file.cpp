#include <algorithm>
#include <cstring>

#include <gale/io/bytes/damaged.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/formats/hdf5_chunk.hpp>
#include <gale/io/formats/hdf5_file.hpp>

namespace gale::io::detail {

namespace {

constexpr std::uint32_t longest_name = 65536;

std::string joined(const std::string& group, const std::string& name) {
  return group.empty() ? name : group + "/" + name;
}

std::uint64_t product_of(std::uint64_t a, std::uint64_t b) {
  return product({static_cast<std::int64_t>(a), static_cast<std::int64_t>(b)}, "an array");
}

using Places = std::vector<std::uint64_t>;

/// Goes on by `step` below `ends`, the last dimension first; false at the end.
bool advance(Places& at, const Places& step, const Places& ends) {
  for (std::size_t d = at.size(); d-- > 0; at[d] = 0) {
    if (ends[d] - at[d] <= step[d]) continue;
    at[d] += step[d];
    return true;
  }
  return false;
}

/// Copies those values of a chunk which the array has, which ends at `ends`; `first` is its first one's place there.
void place_chunk(const char* values, const Places& chunk, const Places& first, const Places& ends,
                 std::size_t value_bytes, char* to) {
  const std::size_t last = chunk.size() - 1;
  Places inside(chunk.size()), step(chunk.size(), 1), size(chunk.size());
  for (std::size_t d = 0; d <= last; ++d) size[d] = std::min(chunk[d], ends[d] - first[d]);
  step[last] = size[last];  // a run at a time
  do {
    std::uint64_t from = 0, place = 0;
    for (std::size_t d = 0; d <= last; ++d) {
      from = from * chunk[d] + inside[d];
      place = place * ends[d] + first[d] + inside[d];
    }
    std::memcpy(to + place * value_bytes, values + from * value_bytes, size[last] * value_bytes);
  } while (advance(inside, step, size));
}

}  // namespace

Hdf5File::Dataset Hdf5File::receive_dataset() {
  Dataset dataset;
  dataset.at = program_.receive<reader::Dataset>();
  const reader::Dataset& at = dataset.at;
  if (at.dimensions > reader::most_dimensions || at.filters > reader::most_filters ||
      at.layout > reader::Layout::chunked)
    damaged("of a dataset HDF5 says what can't be");
  if (at.type <= static_cast<int>(ValueType::float64)) dataset.type = static_cast<ValueType>(at.type);
  dataset.is_text = at.is_text != 0;
  dataset.order = at.is_big_endian != 0 ? ByteOrder::big : ByteOrder::little;
  const auto receive_all = [&](auto& values, std::size_t count) {
    values.resize(count);
    program_.receive(values.data(), count * sizeof values[0]);
  };
  receive_all(dataset.shape, at.dimensions);
  if (at.layout == reader::Layout::chunked) receive_all(dataset.chunk, at.dimensions);
  receive_all(dataset.filters, at.filters);
  return dataset;
}

bool Hdf5File::open_group(const std::string& path, std::vector<std::string>* names) {
  program_.ask(reader::Request::group, {path});
  const bool is_there = program_.receive<std::uint8_t>() != 0;
  for (auto rest = program_.receive<std::uint64_t>(); rest > 0; --rest) {
    const std::string name = program_.receive_text(longest_name);
    Dataset dataset = receive_dataset();
    dataset.name = joined(path, name);
    datasets_[dataset.name] = std::move(dataset);
    if (names != nullptr) names->push_back(name);
  }
  return is_there;
}

const FileArray* Hdf5File::find(const std::string& path) const {
  const auto found = datasets_.find(path);
  return found == datasets_.end() ? nullptr : &found->second;
}

std::optional<std::uint64_t> Hdf5File::dimension(const std::string& name) const {
  const FileArray* const array = find(name);
  if (array == nullptr || array->shape.size() != 1) return std::nullopt;
  return array->shape[0];
}

std::optional<FileAttribute> Hdf5File::attribute(const std::string& path, const std::string& name) {
  program_.ask(reader::Request::attribute, {path, name});
  FileAttribute result;
  switch (program_.receive<reader::AttributeKind>()) {
    case reader::AttributeKind::text:
      result.text = program_.receive_text(1 << 30);
      return result;
    case reader::AttributeKind::numbers: {
      const auto count = program_.receive<std::uint32_t>();
      if (count > longest_name) damaged("an attribute has " + std::to_string(count) + " numbers");
      result.numbers.resize(count);
      program_.receive(result.numbers.data(), count * sizeof(double));
      return result;
    }
    case reader::AttributeKind::none:
      break;
  }
  return std::nullopt;
}

std::uint64_t Hdf5File::stored_bytes(const FileArray& array, std::uint64_t rows, std::uint64_t bytes) {
  const Dataset& dataset = datasets_.at(array.name);
  const std::uint64_t all = product_of(dataset.count(dataset.rows()), size_of(*dataset.type));
  if (dataset.at.layout != reader::Layout::chunked) {
    if (dataset.at.layout == reader::Layout::contiguous && dataset.at.address == reader::no_address)
      damaged("its '" + array.name + "' has no values");
    if (dataset.at.stored < all) {
      damaged("its '" + array.name + "' has " + std::to_string(dataset.at.stored) + " bytes, not " +
              std::to_string(all));
    }
    return bytes;
  }
  require_known_filters(dataset.filters, array.name);
  program_.ask(reader::Request::chunks, {array.name, std::to_string(rows)});
  const auto stored = program_.receive<std::uint64_t>();
  const std::uint64_t ratio = dataset.filters.empty() ? 1 : best_deflate_ratio;
  if (all / ratio > stored) {
    damaged("its '" + array.name + "' stands for " + std::to_string(all) + " bytes, and there are " +
            std::to_string(stored) + " of them");
  }
  return stored;
}

void Hdf5File::copy(const FileArray& array, std::uint64_t rows, char* to, std::uint64_t bytes) {
  const Dataset& dataset = datasets_.at(array.name);
  if (dataset.at.layout == reader::Layout::chunked) return copy_chunks(dataset, rows, to);
  if (dataset.at.layout == reader::Layout::contiguous) return file_.read(dataset.at.address, to, bytes);
  program_.ask(reader::Request::bytes, {array.name});
  std::vector<char> all(static_cast<std::size_t>(dataset.at.stored));
  program_.receive(all.data(), all.size());
  std::memcpy(to, all.data(), bytes);
}

void Hdf5File::copy_chunks(const Dataset& dataset, std::uint64_t rows, char* to) {
  const std::size_t rank = dataset.shape.size(), value_bytes = size_of(*dataset.type);
  std::vector<std::uint64_t> ends = dataset.shape, first(rank);
  ends[0] = rows;
  std::uint64_t chunk_bytes = value_bytes, unread = file_.size();
  for (const std::uint64_t length : dataset.chunk) {
    if (length == 0) damaged("the chunks of its '" + dataset.name + "' are empty");
    chunk_bytes = product_of(chunk_bytes, length);
  }
  do {
    const auto chunk = program_.receive<reader::Chunk>();
    if (chunk.bytes > unread) damaged("the chunks of its '" + dataset.name + "' are longer than the file");
    unread -= chunk.bytes;
    std::vector<char> stored(static_cast<std::size_t>(chunk.bytes));
    program_.receive(stored.data(), stored.size());
    const std::vector<char> values =
        decoded_chunk(std::move(stored), dataset.filters, chunk.left_out, chunk_bytes, value_bytes, dataset.name);
    place_chunk(values.data(), dataset.chunk, first, ends, value_bytes, to);
  } while (advance(first, dataset.chunk, ends));
}

}  // namespace gale::io::detail
