#include <algorithm>
#include <array>

#include <gale/io/program/file.hpp>

namespace gale::reader {

namespace {

/// Keeps the error that all others came of.
herr_t keep_first(unsigned, const H5E_error2_t* error, void* to) {
  auto& first = *static_cast<std::string*>(to);
  if (first.empty() && error->desc != nullptr) first = error->desc;
  return 0;
}

/// The types of numbers in the order of gale::io::detail::ValueType.
std::array<hid_t, 10> types_in(bool is_big_endian) {
  if (is_big_endian)
    return {H5T_STD_I8BE,  H5T_STD_U8BE,  H5T_STD_I16BE, H5T_STD_U16BE,  H5T_STD_I32BE,
            H5T_STD_U32BE, H5T_STD_I64BE, H5T_STD_U64BE, H5T_IEEE_F32BE, H5T_IEEE_F64BE};
  return {H5T_STD_I8LE,  H5T_STD_U8LE,  H5T_STD_I16LE, H5T_STD_U16LE,  H5T_STD_I32LE,
          H5T_STD_U32LE, H5T_STD_I64LE, H5T_STD_U64LE, H5T_IEEE_F32LE, H5T_IEEE_F64LE};
}

/// Finds the type of numbers that lie in one of the usual ways.
void put_number_type(hid_t type, DatasetHeader& to) {
  for (const bool is_big_endian : {false, true}) {
    const auto types = types_in(is_big_endian);
    for (std::size_t k = 0; k < types.size(); ++k) {
      if (H5Tequal(type, types[k]) <= 0) continue;
      to.type = static_cast<std::uint8_t>(k);
      to.is_big_endian = is_big_endian;
      return;
    }
  }
}

Handle space_of(hid_t dataset) { return {H5Dget_space(dataset), H5Sclose, "a shape"}; }

std::vector<std::uint64_t> shape_of(hid_t space) {
  if (H5Sget_simple_extent_type(space) == H5S_NULL) return {0};
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 0 || rank > static_cast<int>(most_dimensions)) fail("a shape");
  std::array<hsize_t, most_dimensions> lengths{};
  if (H5Sget_simple_extent_dims(space, lengths.data(), nullptr) < 0) fail("a shape");
  return {lengths.begin(), lengths.begin() + rank};
}

[[noreturn]] void refuse(const std::string& dataset, const std::string& why) {
  throw std::runtime_error("its '" + dataset + "' " + why + ": such are not read");
}

/// Throws for values that other files have.
void require_own_values(hid_t creation, const std::string& path) {
  char name[1000] = {};
  if (H5Pget_layout(creation) == H5D_VIRTUAL) {
    H5Pget_virtual_filename(creation, 0, name, sizeof name);
    refuse(path, std::string("consists of parts of other datasets, in the file '") + name + "'");
  }
  const int outside = H5Pget_external_count(creation);
  if (outside < 0) fail(path);
  if (outside > 0) {
    off_t offset = 0;
    hsize_t size = 0;
    H5Pget_external(creation, 0, sizeof name - 1, name, &offset, &size);
    refuse(path, std::string("has its values in the file '") + name + "'");
  }
}

/// Throws unless the link is a hard one.
void require_hard(hid_t group, const std::string& name, const std::string& path, const H5L_info_t& link) {
  if (link.type == H5L_TYPE_HARD) return;
  if (link.type != H5L_TYPE_EXTERNAL && link.type != H5L_TYPE_SOFT) refuse(path, "is a link of an unknown kind");
  std::vector<char> value(std::min<std::size_t>(link.u.val_size, 65536) + 1);
  if (H5Lget_val(group, name.c_str(), value.data(), value.size() - 1, H5P_DEFAULT) < 0) fail(path);
  if (link.type == H5L_TYPE_SOFT) refuse(path, std::string("is a soft link to '") + value.data() + "'");
  const char *file = nullptr, *object = nullptr;
  if (H5Lunpack_elink_val(value.data(), value.size() - 1, nullptr, &file, &object) < 0) fail(path);
  refuse(path, std::string("is a link to '") + object + "' in the file '" + file + "'");
}

using Links = std::vector<std::pair<std::string, H5L_info_t>>;

herr_t keep_link(hid_t, const char* name, const H5L_info_t* link, void* to) {
  static_cast<Links*>(to)->emplace_back(name, *link);
  return 0;
}

}  // namespace

void fail(const std::string& what) {
  std::string first;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &first);
  throw std::runtime_error("it is damaged, incomplete or of another format (of " + what + " HDF5 says: " + first + ")");
}

Handle::Handle(hid_t id, Close close, const char* what) : id_(id), close_(close) {
  if (id < 0) fail(what);
}

namespace {

/// HDF5 takes what is in memory for a file. It would copy it, but for these.
Handle open_image(const void* image, std::size_t bytes) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  H5PLset_loading_state(0);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "a list");
  static const void* place;
  place = image;
  H5FD_file_image_callbacks_t callbacks{};
  callbacks.image_malloc = [](size_t, H5FD_file_image_op_t, void*) { return const_cast<void*>(place); };
  callbacks.image_memcpy = [](void* to, const void*, size_t, H5FD_file_image_op_t, void*) { return to; };
  callbacks.image_free = [](void*, H5FD_file_image_op_t, void*) { return herr_t(0); };
  if (H5Pset_fapl_core(access, 1 << 16, 0) < 0 || H5Pset_file_image_callbacks(access, &callbacks) < 0 ||
      H5Pset_file_image(access, const_cast<void*>(image), bytes) < 0)
    fail("the file");
  return {H5Fopen("the file", H5F_ACC_RDONLY, access), H5Fclose, "the file"};
}

}  // namespace

File::File(const void* image, std::size_t bytes) : file_(open_image(image, bytes)) {}

bool File::leads_somewhere(const std::string& path) const {
  for (std::size_t end = 0; end < path.size();) {
    end = std::min(path.find('/', end + 1), path.size());
    const std::string part = path.substr(0, end);
    const htri_t exists = H5Lexists(file_, part.c_str(), H5P_DEFAULT);
    if (exists < 0) fail(part);
    if (exists == 0) return false;
    H5L_info_t link;
    if (H5Lget_info(file_, part.c_str(), &link, H5P_DEFAULT) < 0) fail(part);
    require_hard(file_, part, part, link);
  }
  return true;
}

bool File::list(const std::string& group, std::vector<Description>& datasets) const {
  if (!leads_somewhere(group)) return false;
  const Handle object(H5Oopen(file_, group.empty() ? "/" : group.c_str(), H5P_DEFAULT), H5Oclose, "a group");
  if (H5Iget_type(object) != H5I_GROUP) return false;
  Links links;
  hsize_t at = 0;
  if (H5Literate(object, H5_INDEX_NAME, H5_ITER_INC, &at, keep_link, &links) < 0) fail("a group");
  for (const auto& [name, link] : links) {
    const std::string path = group.empty() ? name : group + "/" + name;
    require_hard(object, name, path, link);
    const Handle member(H5Oopen(object, name.c_str(), H5P_DEFAULT), H5Oclose, "an object");
    if (H5Iget_type(member) == H5I_DATASET) {
      datasets.push_back(describe(path));
      datasets.back().name = name;
    }
  }
  return true;
}

Handle File::open(const std::string& path) const {
  return {H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, "a dataset"};
}

File::Description File::describe(const std::string& path) const {
  const Handle dataset = open(path);
  const Handle creation(H5Dget_create_plist(dataset), H5Pclose, "a dataset");
  require_own_values(creation, path);
  Description result;
  result.shape = shape_of(space_of(dataset));
  const Handle type(H5Dget_type(dataset), H5Tclose, "a type");
  put_number_type(type, result.fixed);
  if (H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0) {
    result.fixed.type = 0;
    result.fixed.is_text = 1;
    if (H5Tget_size(type) != 1) result.shape.push_back(H5Tget_size(type));
  }
  switch (H5Pget_layout(creation)) {
    case H5D_COMPACT:
      result.fixed.layout = Layout::compact;
      result.fixed.stored = H5Dget_storage_size(dataset);
      break;
    case H5D_CONTIGUOUS: {
      const haddr_t address = H5Dget_offset(dataset);
      result.fixed.address = address == HADDR_UNDEF ? no_address : address;
      result.fixed.stored = H5Dget_storage_size(dataset);
      break;
    }
    case H5D_CHUNKED: {
      result.fixed.layout = Layout::chunked;
      std::array<hsize_t, most_dimensions> lengths{};
      const int rank = H5Pget_chunk(creation, most_dimensions, lengths.data());
      const bool has_texts = result.fixed.is_text != 0 && H5Tget_size(type) != 1;
      if (rank < 1 || rank + (has_texts ? 1 : 0) != static_cast<int>(result.shape.size())) fail(path);
      result.chunk.assign(lengths.begin(), lengths.begin() + rank);
      if (has_texts) result.chunk.push_back(result.shape.back());
      for (const std::uint64_t length : result.chunk) {
        if (length == 0) fail(path);
      }
      break;
    }
    default:
      refuse(path, "lies in a way that is not known");
  }
  const int filters = H5Pget_nfilters(creation);
  if (filters < 0 || filters > static_cast<int>(most_filters)) fail(path);
  for (int k = 0; k < filters; ++k) {
    unsigned flags = 0, configuration = 0;
    std::size_t numbers = 0;
    result.filters.push_back(static_cast<std::uint32_t>(
        H5Pget_filter2(creation, static_cast<unsigned>(k), &flags, &numbers, nullptr, 0, nullptr, &configuration)));
  }
  result.fixed.dimensions = static_cast<std::uint16_t>(result.shape.size());
  result.fixed.filters = static_cast<std::uint16_t>(result.filters.size());
  return result;
}

File::Attribute File::attribute(const std::string& object, const std::string& name) const {
  Attribute result;
  const Handle owner(H5Oopen(file_, object.empty() ? "/" : object.c_str(), H5P_DEFAULT), H5Oclose, "an object");
  const htri_t exists = H5Aexists(owner, name.c_str());
  if (exists < 0) fail(name);
  if (exists == 0) return result;
  const Handle attribute(H5Aopen(owner, name.c_str(), H5P_DEFAULT), H5Aclose, "an attribute");
  const Handle type(H5Aget_type(attribute), H5Tclose, "a type");
  const Handle space(H5Aget_space(attribute), H5Sclose, "a shape");
  constexpr hssize_t most = 4096;  // characters or numbers
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (H5Tget_class(type) == H5T_STRING && count == 1) {
    result.kind = AttributeKind::text;
    if (H5Tis_variable_str(type) > 0) {
      char* text = nullptr;
      if (H5Aread(attribute, type, &text) < 0) fail(name);
      if (text != nullptr) result.text = text;
      H5free_memory(text);
    } else if (H5Tget_size(type) <= std::size_t(most)) {
      result.text.resize(H5Tget_size(type));
      if (H5Aread(attribute, type, result.text.data()) < 0) fail(name);
    }
    return result;
  }
  DatasetHeader found;
  put_number_type(type, found);
  if (found.type == no_type || count < 0 || count > most) return result;
  result.kind = AttributeKind::numbers;
  result.numbers.resize(static_cast<std::size_t>(count));
  if (count > 0 && H5Aread(attribute, H5T_NATIVE_DOUBLE, result.numbers.data()) < 0) fail(name);
  return result;
}

}  // namespace gale::reader
