#include <cmath>
#include <cstring>

#include <gale/io/bytes/compression.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/formats/volume.hpp>

namespace gale::io::detail {
namespace {

/// The fields of a NIfTI header, of version 1 or 2, that matter here; names as in nifti1.h.
struct NiftiHeader {
  ByteOrder order = byte_order_of_machine();
  std::size_t bytes = 0;
  std::array<std::int64_t, 8> dim{};
  std::array<double, 8> pixdim{};
  std::int64_t datatype = 0, qform_code = 0, sform_code = 0;
  double vox_offset = 0, scl_slope = 0, scl_inter = 0;
  std::array<double, 3> quatern{}, qoffset{};
  std::array<std::array<double, 4>, 3> srow{};
};

constexpr std::size_t size_of_1 = 348, size_of_2 = 540;

/// Reads fields out of the bytes of a header.
struct Fields {
  const std::vector<char>& bytes;
  ByteOrder order;

  template <class T>
  T at(std::size_t offset) const {
    T value;
    std::memcpy(&value, &bytes[offset], sizeof(T));
    to_machine_order(&value, 1, order);
    return value;
  }

  template <class T, class To, std::size_t N>
  void copy(std::size_t offset, std::array<To, N>& to) const {
    for (std::size_t k = 0; k < N; ++k) to[k] = at<T>(offset + k * sizeof(T));
  }
};

/// `Integer` and `Real` are the header's types; the numbers are the offsets of its fields.
template <class Integer, class Real, class Code>
void take_fields(const Fields& from, std::size_t datatype, std::size_t dim, std::size_t pixdim, std::size_t vox_offset,
                 std::size_t slope, std::size_t codes, std::size_t quatern, NiftiHeader& to) {
  to.datatype = from.at<std::int16_t>(datatype);
  from.copy<Integer>(dim, to.dim);
  from.copy<Real>(pixdim, to.pixdim);
  if constexpr (sizeof(Real) == 4) {
    to.vox_offset = from.at<float>(vox_offset);
  } else {
    to.vox_offset = static_cast<double>(from.at<std::int64_t>(vox_offset));
  }
  to.scl_slope = from.at<Real>(slope);
  to.scl_inter = from.at<Real>(slope + sizeof(Real));
  to.qform_code = from.at<Code>(codes);
  to.sform_code = from.at<Code>(codes + sizeof(Code));
  from.copy<Real>(quatern, to.quatern);
  from.copy<Real>(quatern + 3 * sizeof(Real), to.qoffset);
  for (std::size_t row = 0; row < 3; ++row) from.copy<Real>(quatern + (6 + 4 * row) * sizeof(Real), to.srow[row]);
}

NiftiHeader read_nifti_header(ByteSource& source) {
  std::vector<char> bytes(size_of_2);
  read_all(source, bytes.data(), size_of_1, "its header");
  NiftiHeader header;
  const auto size = [&](ByteOrder order) { return Fields{bytes, order}.at<std::int32_t>(0); };
  for (const ByteOrder order : {ByteOrder::little, ByteOrder::big}) {
    if (size(order) == size_of_1 || size(order) == size_of_2) {
      header.order = order;
      header.bytes = static_cast<std::size_t>(size(order));
    }
  }
  if (header.bytes == size_of_2) {
    read_all(source, &bytes[size_of_1], size_of_2 - size_of_1, "its header");
    if (std::memcmp(&bytes[4], "n+2", 4) != 0 && std::memcmp(&bytes[4], "ni2", 4) != 0) damaged("it is no NIfTI file");
    take_fields<std::int64_t, double, std::int32_t>({bytes, header.order}, 12, 16, 104, 168, 176, 344, 352, header);
  } else {
    if (header.bytes != size_of_1 ||
        (std::memcmp(&bytes[344], "n+1", 4) != 0 && std::memcmp(&bytes[344], "ni1", 4) != 0))
      damaged("it is no NIfTI file");
    take_fields<std::int16_t, float, std::int16_t>({bytes, header.order}, 70, 40, 76, 108, 112, 252, 256, header);
  }
  return header;
}

void take_type(const NiftiHeader& header, Volume& volume) {
  struct Type {
    int code;
    ValueType type;
    int components;
  };
  static constexpr Type types[] = {
      {2, ValueType::uint8, 1},      {4, ValueType::int16, 1},    {8, ValueType::int32, 1},
      {16, ValueType::float32, 1},   {32, ValueType::float32, 2}, {64, ValueType::float64, 1},
      {128, ValueType::uint8, 3},    {256, ValueType::int8, 1},   {512, ValueType::uint16, 1},
      {768, ValueType::uint32, 1},   {1024, ValueType::int64, 1}, {1280, ValueType::uint64, 1},
      {1792, ValueType::float64, 2}, {2304, ValueType::uint8, 4}};
  for (const Type& type : types) {
    if (type.code != header.datatype) continue;
    volume.type = type.type;
    volume.components = type.components;
    return;
  }
  damaged("its values are of the NIfTI type ", header.datatype);
}

/// The rotation of a unit quaternion, whose b, c and d are given.
std::array<std::array<double, 3>, 3> rotation(const std::array<double, 3>& bcd) {
  const auto [b, c, d] = bcd;
  const double rest = 1 - b * b - c * c - d * d, a = rest > 0 ? std::sqrt(rest) : 0;
  const double s = 1 / (a * a + b * b + c * c + d * d);
  return {{{(a * a + b * b - c * c - d * d) * s, 2 * (b * c - a * d) * s, 2 * (b * d + a * c) * s},
           {2 * (b * c + a * d) * s, (a * a - b * b + c * c - d * d) * s, 2 * (c * d - a * b) * s},
           {2 * (b * d - a * c) * s, 2 * (c * d + a * b) * s, (a * a - b * b - c * c + d * d) * s}}};
}

/// Places the voxels, in the file's order, by its sform, else its qform, else its spacing alone.
void place(const NiftiHeader& header, Image& image) {
  auto& to = image.index_to_physical;
  if (header.sform_code > 0) {
    to = header.srow;
    return;
  }
  std::array<double, 3> spacing;
  for (int k = 0; k < 3; ++k) spacing[k] = header.pixdim[k + 1] == 0 ? 1 : header.pixdim[k + 1];
  if (header.qform_code <= 0) {
    for (int d = 0; d < 3; ++d) to[d][d] = spacing[d];
    return;
  }
  if (header.pixdim[0] < 0) spacing[2] = -spacing[2];
  const auto turned = rotation(header.quatern);
  for (int d = 0; d < 3; ++d) {
    constexpr double rounding = 2.384185791015625e-07;  // 2^-22: what is left of a zero in single precision
    for (int k = 0; k < 3; ++k) to[d][k] = std::abs(turned[d][k]) < rounding ? 0 : turned[d][k] * spacing[k];
    to[d][3] = header.qoffset[d];
  }
}

void skip(ByteSource& source, std::uint64_t bytes) {
  if (bytes > source.at_most()) damaged("its voxels begin ", bytes, " bytes behind its header");
  skip_all(source, bytes, "what comes before its voxels");
}

/// Reads planes of components, one after the other, with all time steps of each: of the first step, component by
/// component.
PointArray::Values read_planes(ByteSource& source, const Volume& whole, std::int64_t planes, std::int64_t times) {
  Volume plane = whole;
  plane.components = whole.components / planes;
  if (whole.bytes() > source.at_most()) damaged("it ends before its ", planes, " components");
  std::vector<PointArray::Values> parts;
  for (std::int64_t p = 0; p < planes; ++p) {
    if (p > 0) skip(source, plane.bytes() * static_cast<std::uint64_t>(times - 1));
    parts.push_back(plane.read(source));
  }
  return std::visit(
      [&](const auto& first) -> PointArray::Values {
        using Vector = std::decay_t<decltype(first)>;
        Vector all(whole.count());
        for (std::int64_t p = 0; p < planes; ++p) {
          const auto& part = std::get<Vector>(parts[p]);
          for (std::size_t k = 0; k < part.size(); ++k) {
            const std::size_t voxel = k / plane.components, component = k % plane.components;
            all[voxel * whole.components + p * plane.components + component] = part[k];
          }
        }
        return all;
      },
      parts.front());
}

}  // namespace

Content read_nifti(const InputFile& file, const ReadOptions&) {
  const bool is_gzip = file.begins_with("\x1f\x8b");
  const std::unique_ptr<ByteSource> source = is_gzip ? inflated(file, 0) : std::make_unique<FileBytes>(file, 0);
  const NiftiHeader header = read_nifti_header(*source);
  const std::int64_t axes = header.dim[0];
  if (axes < 1 || axes > 7) damaged("it has ", axes, " dimensions");
  const auto extent = [&](int axis) { return axis <= axes ? header.dim[axis] : 1; };
  for (int axis = 1; axis <= axes; ++axis) {
    if (header.dim[axis] < 1) damaged("its dimension ", axis, " is ", header.dim[axis]);
  }
  Volume volume;
  volume.order = header.order;
  volume.dimensions = {extent(1), extent(2), extent(3)};
  take_type(header, volume);
  const std::int64_t times = extent(4), planes = extent(5);
  product({planes, volume.components}, "components");
  product({extent(1), extent(2), extent(3), times, planes, volume.components, 8}, "dimensions");
  volume.components *= planes;

  const double begin = header.vox_offset == 0 ? static_cast<double>(header.bytes + 4) : header.vox_offset;
  if (!(begin >= static_cast<double>(header.bytes)) || begin > 1e15 || begin != std::floor(begin))
    damaged("its voxels begin at byte ", begin);
  const std::uint64_t behind_header = static_cast<std::uint64_t>(begin) - header.bytes;
  std::optional<PointArray::Values> values;
  if (is_gzip && times == 1 && planes == 1)  // then all of it is wanted, as it is
    values = volume.read_at_once(file, 0, header.bytes + behind_header);
  if (!values) {
    skip(*source, behind_header);
    values = planes > 1 ? read_planes(*source, volume, planes, times) : volume.read(*source);
    check_sum(*source);
  }
  Image image = volume.image("NIFTI", std::move(*values));
  place(header, image);
  require_finite(image);
  rescale(image, header.scl_slope, header.scl_inter);
  if (times > 1) image.notices.push_back("left out all but the first of " + std::to_string(times) + " time steps");
  return image;
}

}  // namespace gale::io::detail
