// gale-hdf5-reader FILE: answers what GALE asks of an HDF5 file, see protocol.hpp: requests come from standard input,
// answers go to standard output. Whatever FILE does to HDF5 ends here: from before its first byte is looked at, this
// process can open nothing else.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>

#include <gale/io/bytes/descriptor.hpp>
#include <gale/io/program/confine.hpp>
#include <gale/io/program/file.hpp>

namespace {

using namespace gale::reader;
using gale::io::detail::Descriptor;
using gale::io::detail::move_all;

/// The bytes of a file.
struct FileImage {
  const void* data = nullptr;
  std::size_t bytes = 0;

  explicit FileImage(const char* path) {
    const Descriptor descriptor(open(path, O_RDONLY | O_CLOEXEC));
    struct stat status = {};
    if (descriptor < 0 || fstat(descriptor, &status) != 0) throw std::runtime_error(std::strerror(errno));
    bytes = static_cast<std::size_t>(status.st_size);
    data = mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (data == MAP_FAILED) throw std::runtime_error(std::strerror(errno));
  }
};

/// Closes descriptors that whoever started GALE may have left open.
void close_inherited() {
#if defined(SYS_close_range)
  if (syscall(SYS_close_range, 3u, ~0u, 0u) == 0) return;
#endif
  for (int descriptor = 3; descriptor < 65536; ++descriptor) close(descriptor);
}

/// The bytes that this process has mapped already.
rlim_t mapped_bytes() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

/// Limits memory and time: what HDF5 needs to find its way in a file is less than the file, and all that is large goes
/// through unread.
void limit_to(std::size_t bytes) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const auto limit = [](auto resource, rlim_t most) {
    rlimit now;
    getrlimit(resource, &now);
    now.rlim_cur = now.rlim_max = std::min(now.rlim_max, most);
    setrlimit(resource, &now);
  };
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  constexpr rlim_t more = rlim_t(2) << 30;
#else
  constexpr rlim_t more = rlim_t(40) << 20;
#endif
  constexpr rlim_t seconds = 3, bytes_a_second = 250000;
  limit(RLIMIT_AS, mapped_bytes() + more + 3 * bytes);
  limit(RLIMIT_CPU, seconds + bytes / bytes_a_second);
  limit(RLIMIT_CORE, 0);
}

void put(const void* from, std::size_t bytes) {
  const auto put_some = [&](std::size_t done, std::size_t rest) {
    return write(STDOUT_FILENO, static_cast<const char*>(from) + done, rest);
  };
  if (!move_all(bytes, put_some)) _exit(2);  // nobody asks any more
}

template <class T>
void put(const T& value) {
  put(&value, sizeof value);
}

template <class T>
void put_all(const std::vector<T>& values) {
  put(values.data(), values.size() * sizeof(T));
}

void put_text(const std::string& text) {
  put(static_cast<std::uint32_t>(text.size()));
  put(text.data(), text.size());
}

/// Reads from standard input; false at the end.
bool get(void* to, std::size_t bytes) {
  return move_all(bytes, [&](std::size_t done, std::size_t rest) {
    return read(STDIN_FILENO, static_cast<char*>(to) + done, rest);
  });
}

void answer_group(const File& file, const std::string& path) {
  std::vector<File::Description> datasets;
  put(static_cast<std::uint8_t>(file.list(path, datasets)));
  put(static_cast<std::uint64_t>(datasets.size()));
  for (const auto& dataset : datasets) {
    put_text(dataset.name);
    put(dataset.fixed);
    put_all(dataset.shape);
    put_all(dataset.chunk);
    put_all(dataset.filters);
  }
}

void answer_attribute(const File& file, const std::string& path, const std::string& name) {
  const File::Attribute attribute = file.attribute(path, name);
  put(attribute.kind);
  if (attribute.kind == AttributeKind::text) put_text(attribute.text);
  if (attribute.kind != AttributeKind::numbers) return;
  put(static_cast<std::uint32_t>(attribute.numbers.size()));
  put_all(attribute.numbers);
}

/// Answers with a compact dataset's bytes, of which HDF5 has no more than 64 KiB.
void answer_bytes(const File& file, const std::string& path) {
  const Handle dataset = file.open(path);
  const Handle type(H5Dget_type(dataset), H5Tclose, "a type");
  const std::uint64_t bytes = file.describe(path).fixed.stored;
  const Handle space(H5Dget_space(dataset), H5Sclose, "a shape");
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (bytes > 65536 || count < 0 || static_cast<std::uint64_t>(count) * H5Tget_size(type) != bytes)
    throw std::runtime_error("its '" + path + "' has a size that isn't that of its values");
  std::vector<char> values(static_cast<std::size_t>(bytes));
  if (H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) fail("a dataset");
  put_all(values);
}

void answer_chunks(const File& file, const std::string& path, std::uint64_t first, std::uint64_t end,
                   std::size_t file_bytes) {
  const Handle dataset = file.open(path);
  const auto description = file.describe(path);
  const auto& chunk = description.chunk;
  auto ends = description.shape;
  ends[0] = end;
  put(static_cast<std::uint64_t>(H5Dget_storage_size(dataset)));
  std::vector<hsize_t> at(chunk.size());
  at[0] = first - first % chunk[0];
  std::vector<char> bytes;
  do {
    hsize_t stored = 0;
    if (H5Dget_chunk_storage_size(dataset, at.data(), &stored) < 0 || stored == 0) {
      std::string place;
      for (const hsize_t k : at) place += (place.empty() ? "" : ", ") + std::to_string(k);
      throw std::runtime_error("its '" + path + "' has no values from (" + place + ") on");
    }
    if (stored > file_bytes) throw std::runtime_error("a chunk of its '" + path + "' is longer than the file");
    bytes.resize(static_cast<std::size_t>(stored));
    std::uint32_t left_out = 0;
    if (H5Dread_chunk(dataset, H5P_DEFAULT, at.data(), &left_out, bytes.data()) < 0) fail("a chunk");
    put(Chunk{stored, left_out});
    put_all(bytes);
  } while (advance(at, chunk, ends));
}

void answer(const File& file, std::size_t file_bytes, const std::vector<char>& request) {
  std::vector<std::string> texts;
  for (std::size_t begin = 1; begin < request.size();) {
    texts.emplace_back(&request[begin]);  // ends by a zero
    begin += texts.back().size() + 1;
  }
  texts.resize(3);
  switch (static_cast<RequestKind>(request[0])) {
    case RequestKind::group:
      return answer_group(file, texts[0]);
    case RequestKind::attribute:
      return answer_attribute(file, texts[0], texts[1]);
    case RequestKind::bytes:
      return answer_bytes(file, texts[0]);
    case RequestKind::chunks:
      return answer_chunks(file, texts[0], std::stoull(texts[1]), std::stoull(texts[2]), file_bytes);
  }
}

void serve(const char* path) {
  close_inherited();
  const FileImage image(path);
  limit_to(image.bytes);
  confine();
  const File file(image.data, image.bytes);
  std::uint32_t length;
  while (get(&length, sizeof length)) {
    std::vector<char> request(length + 1);
    if (length == 0 || !get(request.data(), length)) return;
    answer(file, image.bytes, request);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::string wrong;
  try {
    if (argc != 2) return 2;
    serve(argv[1]);
  } catch (const std::bad_alloc&) {
    wrong = "it is damaged: to find its way in it takes more memory than it has bytes";
  } catch (const std::exception& error) {
    wrong = error.what();
  }
  // Libraries do not clean up: the file may have left them in any state.
  if (wrong.empty()) _exit(0);
  _exit(write(STDERR_FILENO, wrong.data(), wrong.size()) > 0 ? 1 : 2);
}
