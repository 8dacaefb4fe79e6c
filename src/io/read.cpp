#include <charconv>
#include <new>
#include <system_error>
#include <utility>
#include <variant>

#include <gale/io/bytes/values.hpp>
#include <gale/io/cells/cells.hpp>
#include <gale/io/formats.hpp>
#include <gale/io/formats/xml_file.hpp>
#include <gale/io/image.hpp>
#include <gale/io/read.hpp>
#include <gale/io/synthetic.hpp>

namespace gale::io {
namespace {

using detail::refuse;

Dataset read_file(const std::string& path, const Format& format, const ReadOptions& options) {
  detail::Content content = format.reader(detail::InputFile(path), options);
  if (auto* image = std::get_if<Image>(&content)) {
    const auto& [nx, ny, nz] = image->dimensions;
    for (const PointArray& array : image->arrays) detail::require_size(array, std::uint64_t(nx) * ny * nz);
    select_scalars(*image, options.array);
    return split_voxels(std::move(*image), options.above, options.grids);
  }
  if (options.above) throw Error("a threshold was given, but it is a mesh, not an image");
  return std::get<Dataset>(std::move(content));
}

/// Returns what read() returns; names the input in whatever goes wrong.
template <class Read>
auto naming(const std::string& input, const Read& read) {
  try {
    return read();
  } catch (const std::bad_alloc&) {
    refuse("cannot read '", input, "': not enough memory");
  } catch (const std::exception& error) {
    refuse("cannot read '", input, "': ", error.what());
  }
}

/// The N of grid:N, or of another input named like that.
int size_in_name(const std::string& input, const ReadOptions& options) {
  int n = 0;
  const char* const end = input.data() + input.size();
  const auto [stop, failure] = std::from_chars(input.data() + input.find(':') + 1, end, n);
  if (failure != std::errc() || stop != end) refuse("cannot make '", input, "': N must be a whole number");
  if (options.above) refuse("cannot apply a threshold to '", input, "': it is a mesh, not an image");
  return n;
}

}  // namespace

std::optional<std::array<Id, 3>> grid_points(const std::string& input, const ReadOptions& options) {
  const std::string kind = input.substr(0, input.find(':') + 1);
  if (kind != "grid:" && kind != "plane:") return std::nullopt;
  const Id n = size_in_name(input, options);
  if (n < 2) refuse(input, kind == "grid:" ? " has no tetrahedra" : " has no triangles", ": N must be at least 2");
  return std::array<Id, 3>{n, n, kind == "grid:" ? n : 1};
}

Dataset read(const std::string& input, const ReadOptions& options) {
  if (const auto points = grid_points(input, options)) {
    const Id n = (*points)[0];
    return (*points)[2] == 1 ? make_plane(n, options.grids) : make_grid(n, options.grids);
  }
  const std::string kind = input.substr(0, input.find(':'));
  if (kind.size() < input.size() && is_synthetic(kind))
    return make_synthetic(kind, size_in_name(input, options), options.grids);
  if (!detail::reads_files())
    refuse("this gale was built without VTK: it reads grid:N, plane:N and the like alone, not '", input, "'");
  const Format* const format = format_of(input);
  if (format == nullptr || format->reader == nullptr) {
    refuse("cannot read '", input, "': its extension is none of ",
           extensions_of([](const Format& one) { return one.reader != nullptr; }),
           ", nor is it grid:N or plane:N; for other meshes: meshio convert '", input, "' mesh.vtu");
  }
  return naming(input, [&] { return read_file(input, *format, options); });
}

std::vector<Step> steps_of(const std::vector<std::string>& inputs, const ReadOptions& options) {
  std::vector<Step> steps;
  for (const std::string& input : inputs) {
    const Format* const format = format_of(input);
    const bool is_series = format != nullptr && format->input == Input::series;
    if (is_series && inputs.size() > 1)
      refuse("'", input, "' is a series of its own, and can't be one of several inputs");
    if (is_series && !detail::reads_files())
      refuse("this gale was built without what reads files: not '", input, "' either");
    if (inputs.size() == 1 && format != nullptr && format->steps != nullptr && detail::reads_files())
      return naming(input, [&] { return format->steps(detail::InputFile(input), options); });
    steps.push_back({static_cast<double>(steps.size()), input});
  }
  return steps;
}

std::optional<PieceNames> piece_names(const std::string& input) {
  const Format* const format = format_of(input);
  const bool names_pieces = format != nullptr && format->pieces != nullptr && format->input == Input::mesh;
  if (!detail::reads_files() || !names_pieces) return std::nullopt;
  return naming(input, [&] { return detail::names_of_pieces(detail::InputFile(input)); });
}

SomePieces read_pieces(const std::string& input, const PieceNames& some, const ReadOptions& options) {
  return naming(input, [&] {
    if (options.above) throw Error("a threshold was given, but it is a mesh, not an image");
    return detail::read_some_pieces(detail::InputFile(input), some, options);
  });
}

void split_pieces(const std::string& input, SomePieces& some, const Array<const GlobalId, HostMemory>& ids,
                  const ReadOptions& options, int dimension) {
  naming(input, [&] {
    detail::FileCells cells{std::move(some.types), std::move(some.ends), std::move(some.connectivity)};
    detail::split_into(some.mesh, cells, ids, options, dimension);
  });
}

}  // namespace gale::io
