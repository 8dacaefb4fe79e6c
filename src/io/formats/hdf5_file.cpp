#include <algorithm>
#include <cstring>

#include <gale/io/bytes/compression.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/formats/hdf5_file.hpp>

namespace gale::io::detail {
namespace {

constexpr std::uint32_t longest_name = 65536;

using Places = std::vector<std::uint64_t>;

/// Copies those values of a chunk which are wanted: the rows from `first_row` on that end at `ends`. `first` is the
/// place of the chunk's first value in the array.
void place_chunk(const char* values, const Places& chunk, const Places& first, std::uint64_t first_row,
                 const Places& ends, std::size_t value_bytes, char* to) {
  const std::size_t last = chunk.size() - 1;
  Places inside(chunk.size()), step(chunk.size(), 1), size(chunk.size());
  for (std::size_t d = 0; d <= last; ++d) size[d] = std::min(chunk[d], ends[d] - first[d]);
  inside[0] = std::max(first[0], first_row) - first[0];
  const std::uint64_t run = size[last] - inside[last];
  step[last] = size[last];  // a run at a time
  do {
    std::uint64_t from = 0, place = 0;
    for (std::size_t d = 0; d <= last; ++d) {
      from = from * chunk[d] + inside[d];
      place = place * ends[d] + first[d] + inside[d] - (d == 0 ? first_row : 0);
    }
    std::memcpy(to + place * value_bytes, values + from * value_bytes, run * value_bytes);
  } while (reader::advance(inside, step, size));
}

constexpr std::uint64_t sum_bytes = 4;  // what fletcher32 has behind the values

[[noreturn]] void wrong_chunk(const std::string& array, const char* why) {
  damaged("a chunk of its '", array, "' ", why);
}

/// The first bytes of all values come first, then their second ones ...
void unshuffle(std::vector<char>& bytes, std::size_t value_bytes) {
  const std::size_t values = bytes.size() / value_bytes;
  if (value_bytes < 2 || values < 2) return;
  std::vector<char> in_order(bytes);  // what is left behind the last whole value stays where it is
  for (std::size_t k = 0; k < value_bytes; ++k) {
    for (std::size_t v = 0; v < values; ++v) in_order[v * value_bytes + k] = bytes[k * values + v];
  }
  bytes = std::move(in_order);
}

/// Fletcher's sum of big-endian words of 16 bits.
std::uint32_t fletcher_sum(const char* bytes, std::size_t count) {
  const auto* at = reinterpret_cast<const unsigned char*>(bytes);
  std::uint64_t low = 0, high = 0;
  const auto add = [&](std::uint32_t word) {
    low = (low + word) % 65535;
    high = (high + low) % 65535;
  };
  for (std::size_t k = 0; k + 1 < count; k += 2) add(std::uint32_t(at[k]) << 8 | at[k + 1]);
  if (count % 2 == 1) add(std::uint32_t(at[count - 1]) << 8);
  return static_cast<std::uint32_t>(high << 16 | low);
}

/// HDF5 folds sums into 1 to 65535; zeros alone give 0.
bool same_sum(std::uint32_t a, std::uint32_t b) {
  return (a & 0xffff) % 65535 == (b & 0xffff) % 65535 && (a >> 16) % 65535 == (b >> 16) % 65535;
}

void take_sum(std::vector<char>& bytes, const std::string& array) {
  if (bytes.size() < sum_bytes) wrong_chunk(array, "has no room for its sum");
  const std::size_t rest = bytes.size() - sum_bytes;
  std::uint32_t said = 0;
  for (std::size_t k = sum_bytes; k-- > 0;) said = said << 8 | static_cast<unsigned char>(bytes[rest + k]);
  bytes.resize(rest);
  if (!same_sum(said, fletcher_sum(bytes.data(), rest))) wrong_chunk(array, "has another sum");
}

/// No stream of zlib's stands for more than that many times its bytes.
constexpr std::uint64_t best_deflate_ratio = 1032;

/// Throws gale::Error unless these are filters that are undone here: deflate, once, shuffle and fletcher32.
void require_known_filters(const std::vector<std::uint32_t>& filters, const std::string& array) {
  int deflates = 0;
  for (const std::uint32_t filter : filters) {
    deflates += filter == reader::deflate;
    const bool is_known = filter == reader::deflate || filter == reader::shuffle || filter == reader::fletcher32;
    if (is_known && deflates < 2) continue;
    refuse("its '", printable(array), "' is packed by HDF5's filter ", filter,
           ": deflate, once, shuffle and fletcher32 are read");
  }
}

/// Undoes the filters of a chunk, all but those whose bit in `left_out` is set: `stored` becomes `bytes` bytes, of
/// values of `value_bytes` each. Throws gale::Error if it can't.
std::vector<char> decoded_chunk(std::vector<char> stored, const std::vector<std::uint32_t>& filters,
                                std::uint64_t left_out, std::uint64_t bytes, std::size_t value_bytes,
                                const std::string& array) {
  const auto applied = [&](std::size_t k) { return (left_out >> k & 1) == 0; };
  for (std::size_t k = filters.size(); k-- > 0;) {
    if (!applied(k)) continue;
    if (filters[k] == reader::fletcher32) take_sum(stored, array);
    if (filters[k] == reader::shuffle) unshuffle(stored, value_bytes);
    if (filters[k] != reader::deflate) continue;
    std::uint64_t before = bytes;
    for (std::size_t j = 0; j < k; ++j) before += applied(j) && filters[j] == reader::fletcher32 ? sum_bytes : 0;
    if (before / best_deflate_ratio > stored.size()) wrong_chunk(array, "stands for less than it should");
    std::vector<char> inflated(static_cast<std::size_t>(before));
    static const Uncompress inflate = find_uncompress("vtkZLibDataCompressor");
    if (!inflate(stored.data(), stored.size(), inflated.data(), inflated.size()))
      wrong_chunk(array, "isn't what deflate makes");
    stored = std::move(inflated);
  }
  if (stored.size() != bytes) wrong_chunk(array, "has another size");
  return stored;
}

}  // namespace

Hdf5File::StoredDataset Hdf5File::receive_dataset() {
  StoredDataset dataset;
  dataset.at = program_.receive<reader::DatasetHeader>();
  const reader::DatasetHeader& at = dataset.at;
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
  program_.ask(reader::RequestKind::group, {path});
  const bool is_there = program_.receive<std::uint8_t>() != 0;
  for (auto rest = program_.receive<std::uint64_t>(); rest > 0; --rest) {
    const std::string name = program_.receive_text(longest_name);
    StoredDataset dataset = receive_dataset();
    dataset.name = path.empty() ? name : path + "/" + name;
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
  program_.ask(reader::RequestKind::attribute, {path, name});
  FileAttribute result;
  switch (program_.receive<reader::AttributeKind>()) {
    case reader::AttributeKind::text:
      result.text = program_.receive_text(1 << 30);
      return result;
    case reader::AttributeKind::numbers: {
      const auto count = program_.receive<std::uint32_t>();
      if (count > longest_name) damaged("an attribute has ", count, " numbers");
      result.numbers.resize(count);
      program_.receive(result.numbers.data(), count * sizeof(double));
      return result;
    }
    case reader::AttributeKind::none:
      break;
  }
  return std::nullopt;
}

std::uint64_t Hdf5File::stored_bytes(const FileArray& array, Rows rows, std::uint64_t bytes) {
  const StoredDataset& dataset = datasets_.at(array.name);
  const std::uint64_t all = product(dataset.count(dataset.rows()), size_of(*dataset.type));
  if (dataset.at.layout != reader::Layout::chunked) {
    if (dataset.at.layout == reader::Layout::contiguous && dataset.at.address == reader::no_address)
      damaged("its '", array.name, "' has no values");
    if (dataset.at.stored < all) damaged("its '", array.name, "' has ", dataset.at.stored, " bytes, not ", all);
    return bytes;
  }
  require_known_filters(dataset.filters, array.name);
  program_.ask(reader::RequestKind::chunks,
               {array.name, std::to_string(rows.first), std::to_string(rows.first + rows.count)});
  const auto stored = program_.receive<std::uint64_t>();
  const std::uint64_t ratio = dataset.filters.empty() ? 1 : best_deflate_ratio;
  if (all / ratio > stored)
    damaged("its '", array.name, "' stands for ", all, " bytes, and there are ", stored, " of them");
  return stored;
}

void Hdf5File::copy(const FileArray& array, Rows rows, char* to, std::uint64_t bytes) {
  const StoredDataset& dataset = datasets_.at(array.name);
  if (dataset.at.layout == reader::Layout::chunked) return copy_chunks(dataset, rows, to);
  const std::uint64_t before = bytes / rows.count * rows.first;
  if (dataset.at.layout == reader::Layout::contiguous) return file_.read(dataset.at.address + before, to, bytes);
  program_.ask(reader::RequestKind::bytes, {array.name});
  std::vector<char> all(static_cast<std::size_t>(dataset.at.stored));
  program_.receive(all.data(), all.size());
  std::memcpy(to, all.data() + before, bytes);
}

void Hdf5File::copy_chunks(const StoredDataset& dataset, Rows rows, char* to) {
  const std::size_t rank = dataset.shape.size(), value_bytes = size_of(*dataset.type);
  std::vector<std::uint64_t> ends = dataset.shape, first(rank);
  ends[0] = rows.first + rows.count;
  std::uint64_t chunk_bytes = value_bytes, unread = file_.size();
  for (const std::uint64_t length : dataset.chunk) {
    if (length == 0) damaged("the chunks of its '", dataset.name, "' are empty");
    chunk_bytes = product(chunk_bytes, length);
  }
  first[0] = rows.first - rows.first % dataset.chunk[0];
  do {
    const auto chunk = program_.receive<reader::Chunk>();
    if (chunk.bytes > unread) damaged("the chunks of its '", dataset.name, "' are longer than the file");
    unread -= chunk.bytes;
    std::vector<char> stored(static_cast<std::size_t>(chunk.bytes));
    program_.receive(stored.data(), stored.size());
    const std::vector<char> values =
        decoded_chunk(std::move(stored), dataset.filters, chunk.left_out, chunk_bytes, value_bytes, dataset.name);
    place_chunk(values.data(), dataset.chunk, first, rows.first, ends, value_bytes, to);
  } while (reader::advance(first, dataset.chunk, ends));
}

}  // namespace gale::io::detail
