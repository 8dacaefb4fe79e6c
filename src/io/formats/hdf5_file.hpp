#pragma once

#include <sys/types.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <gale/io/bytes/descriptor.hpp>
#include <gale/io/formats/array_file.hpp>
#include <gale/io/program/protocol.hpp>

namespace gale::io::detail {

/// gale-hdf5-reader with a file, and what passes between it and us.
class Hdf5Program {
 public:
  /// Throws gale::Error if it isn't there, or can't be run.
  explicit Hdf5Program(const std::string& path);
  ~Hdf5Program();
  Hdf5Program(const Hdf5Program&) = delete;
  Hdf5Program& operator=(const Hdf5Program&) = delete;

  /// Sends a request, whose texts have no zeros.
  void ask(reader::RequestKind request, const std::vector<std::string>& texts);

  /// Waits for the next bytes of its answer. Throws gale::Error with what it says is wrong, or how it ended.
  void receive(void* to, std::size_t bytes);
  template <class T>
  T receive() {
    T value;
    receive(&value, sizeof value);
    return value;
  }
  std::string receive_text(std::uint32_t most);

 private:
  /// Waits until it has ended; returns its status.
  int wait();
  [[noreturn]] void throw_end();

  Descriptor talk_, message_;
  pid_t process_ = -1;
};

/// An HDF5 file. gale-hdf5-reader says what is where in it; values come from the file itself, or in chunks, which are
/// decoded here. All that the program says is checked.
class Hdf5File : public ArrayFile {
 public:
  /// The file must outlive it.
  explicit Hdf5File(const InputFile& file) : ArrayFile(file), program_(file.path()) {}

  /// Makes the datasets of a group known, by their paths; false if there is no such group. Returns their names, too.
  bool open_group(const std::string& path, std::vector<std::string>* names = nullptr);

  const FileArray* find(const std::string& path) const override;

  /// NetCDF has a dimension as a dataset of that length.
  std::optional<std::uint64_t> dimension(const std::string& name) const override;

  /// An attribute of a dataset or a group that is there.
  std::optional<FileAttribute> attribute(const std::string& path, const std::string& name) override;

 protected:
  std::uint64_t stored_bytes(const FileArray& array, Rows rows, std::uint64_t bytes) override;
  void copy(const FileArray& array, Rows rows, char* to, std::uint64_t bytes) override;

 private:
  struct StoredDataset : FileArray {
    reader::DatasetHeader at;
    std::vector<std::uint64_t> chunk;  ///< how much of each dimension a chunk has
    std::vector<std::uint32_t> filters;
  };

  StoredDataset receive_dataset();
  void copy_chunks(const StoredDataset& dataset, Rows rows, char* to);

  Hdf5Program program_;
  std::map<std::string, StoredDataset> datasets_;
};

}  // namespace gale::io::detail
