#include <cstring>

#include <gale/io/bytes/text.hpp>
#include <gale/io/formats/xml_file.hpp>
#include <gale/io/libraries/headers.hpp>

namespace gale::io::detail {
namespace {

constexpr std::size_t deepest = 32, most_elements = 200000;

/// Builds the tree from what expat tells. What goes wrong is kept and told at the end: no exception may pass through C.
class Builder {
 public:
  Builder(XmlFile& to, const std::string& cell_array)
      : to_(to), cell_array_(cell_array), parser_(XML_ParserCreate(nullptr)) {
    if (parser_ == nullptr) throw std::bad_alloc();
    XML_SetUserData(parser_, this);
    XML_SetElementHandler(parser_, start, end);
    XML_SetCharacterDataHandler(parser_, text);
    XML_SetStartDoctypeDeclHandler(parser_, doctype);
  }
  ~Builder() { XML_ParserFree(parser_); }
  Builder(const Builder&) = delete;
  Builder& operator=(const Builder&) = delete;

  void parse() {
    constexpr std::size_t bytes_at_once = 1 << 18;
    std::vector<char> buffer(bytes_at_once);
    const std::uint64_t size = to_.file.size();
    for (std::uint64_t at = 0; !at_appended_; at += buffer.size()) {
      const bool last = size - at <= buffer.size();
      if (last) buffer.resize(static_cast<std::size_t>(size - at));
      to_.file.read(at, buffer.data(), buffer.size());
      const XML_Status status = XML_Parse(parser_, buffer.data(), static_cast<int>(buffer.size()), last);
      if (out_of_memory_) throw std::bad_alloc();
      if (!failure_.empty()) damaged(failure_);
      if (status != XML_STATUS_OK && !at_appended_)
        damaged(XML_ErrorString(XML_GetErrorCode(parser_)), " in line ", XML_GetCurrentLineNumber(parser_));
      if (last) break;
    }
    if (at_appended_) find_appended();
  }

 private:
  static void start(void* self, const char* name, const char** attributes) {
    static_cast<Builder*>(self)->guarded([&](Builder& b) { b.begin_element(name, attributes); });
  }
  static void end(void* self, const char*) {
    static_cast<Builder*>(self)->guarded([](Builder& b) { b.end_element(); });
  }
  static void text(void* self, const char* characters, int count) {
    static_cast<Builder*>(self)->guarded([&](Builder& b) {
      if (b.keeps_text_) b.open_.back()->text.append(characters, static_cast<std::size_t>(count));
    });
  }
  static void doctype(void* self, const char*, const char*, const char*, int) {
    static_cast<Builder*>(self)->fail("it declares a document type");
  }

  template <class Do>
  void guarded(const Do& act) {
    try {
      act(*this);
    } catch (const std::exception&) {
      out_of_memory_ = true;
      XML_StopParser(parser_, XML_FALSE);
    }
  }

  void fail(const char* what) {
    failure_ = what;
    XML_StopParser(parser_, XML_FALSE);
  }

  void begin_element(const char* name, const char** attributes) {
    if (++elements_ > most_elements) return fail("it has more than 200000 elements");
    if (open_.size() == deepest) return fail("its elements are nested more than 32 deep");
    XmlElement element;
    element.name = name;
    for (; attributes[0] != nullptr; attributes += 2) element.attributes[attributes[0]] = attributes[1];
    const std::string parent = open_.empty() ? "" : open_.back()->name;
    if (element.name == "AppendedData" && open_.size() == 1) {
      to_.appended_is_raw = element.attribute("encoding") == "raw";
      const XML_Index at = XML_GetCurrentByteIndex(parser_);
      to_.appended_begin =
          static_cast<std::uint64_t>(at) + static_cast<std::uint64_t>(XML_GetCurrentByteCount(parser_));
      at_appended_ = true;
      XML_StopParser(parser_, XML_FALSE);
      return;
    }
    const std::string array = element.attribute("Name");
    keeps_text_ =
        element.name == "DataArray" &&
        (parent == "PointData" || parent == "Points" || parent == "Cells" || parent == "Coordinates" ||
         parent == "Polys" || parent == "Strips" || ((parent == "Verts" || parent == "Lines") && array == "offsets") ||
         array == ghost_array || (parent == "CellData" && array == cell_array_));
    if (open_.empty()) {
      to_.root = std::move(element);
      open_.push_back(&to_.root);
    } else {
      open_.back()->children.push_back(std::move(element));
      open_.push_back(&open_.back()->children.back());  // its siblings come when it is closed
    }
  }

  void end_element() {
    keeps_text_ = false;
    if (!open_.empty()) open_.pop_back();
  }

  /// Finds where the appended data begins, behind an underscore.
  void find_appended() {
    char c = ' ';
    std::uint64_t at = to_.appended_begin;
    for (; at < to_.file.size() && std::strchr(" \t\r\n", c) != nullptr; ++at) to_.file.read(at, &c, 1);
    if (c != '_') damaged("its appended data doesn't begin with an underscore");
    to_.appended_begin = at;
  }

  XmlFile& to_;
  const std::string& cell_array_;
  XML_Parser parser_;
  std::vector<XmlElement*> open_;
  std::size_t elements_ = 0;
  bool keeps_text_ = false, at_appended_ = false, out_of_memory_ = false;
  std::string failure_;
};

}  // namespace

void read_tree(XmlFile& to, const std::string& cell_array) { Builder(to, cell_array).parse(); }

}  // namespace gale::io::detail
