#pragma once

#include <map>
#include <string>
#include <vector>

#include <gale/io/formats/array_file.hpp>
#include <gale/io/formats/hdf5_program.hpp>

namespace gale::io::detail {

/// An HDF5 file. Of it gale-hdf5-reader says what is where; values come from the file itself, or in chunks, which are
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

  /// Of a dataset or a group that is there.
  std::optional<FileAttribute> attribute(const std::string& path, const std::string& name) override;

 protected:
  std::uint64_t stored_bytes(const FileArray& array, std::uint64_t rows, std::uint64_t bytes) override;
  void copy(const FileArray& array, std::uint64_t rows, char* to, std::uint64_t bytes) override;

 private:
  struct Dataset : FileArray {
    reader::Dataset at;
    std::vector<std::uint64_t> chunk;  ///< how much of each dimension a chunk has
    std::vector<std::uint32_t> filters;
  };

  Dataset receive_dataset();
  void copy_chunks(const Dataset& dataset, std::uint64_t rows, char* to);

  Hdf5Program program_;
  std::map<std::string, Dataset> datasets_;
};

}  // namespace gale::io::detail
