#pragma once

#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/runtime/structure.hpp>

namespace gale::detail {

/// An array of zeros on the host, whose memory is taken as it is written.
template <class T>
class ZeroedRoom {
 public:
  ZeroedRoom() : entries_(nullptr, std::free) {}

  /// Throws OutOfMemory.
  explicit ZeroedRoom(std::size_t count)
      : entries_(static_cast<T*>(std::calloc(count == 0 ? 1 : count, sizeof(T))), std::free) {
    if (entries_ == nullptr)
      throw OutOfMemory("the host has no " + std::to_string(count * sizeof(T)) + " bytes for what changes");
  }

  T* data() const { return entries_.get(); }
  T& operator[](std::size_t i) const { return entries_.get()[i]; }

 private:
  std::unique_ptr<T, void (*)(void*)> entries_;
};

/// The neighbours and links of some vertices of a mesh, on the host.
class ChangedStars {
 public:
  /// `structure()` has the rows; none: those of a grid are computed.
  ChangedStars(const Mesh& mesh, std::function<Structure&()> structure);

  /// Reads those of `vertices`, ascending, each once.
  void gather(std::vector<Id> vertices, int threads);

  /// The vertices that were read.
  const std::vector<Id>& vertices() const { return vertices_; }

  /// The place of a vertex among these; no_id.
  Id place(Id vertex) const {
    const Id place = place_[vertex];
    return place < static_cast<Id>(vertices_.size()) && vertices_[place] == vertex ? place : no_id;
  }

  /// The neighbours of all of them, one after the other.
  const std::vector<Id>& all_neighbours() const { return rows_; }

  Row neighbours(Offset place) const {
    return {rows_.data() + row_begin_[place], static_cast<Id>(row_begin_[place + 1] - row_begin_[place])};
  }
  LinkRow link(Offset place) const {
    LinkRow link = shapes_[place];
    link.places = links_.data() + link_begin_[place];
    return link;
  }

 private:
  const Mesh mesh_;
  const std::function<Structure&()> structure_;
  ZeroedRoom<Id> place_;  ///< of each vertex of the mesh, as far as it is one of them
  std::vector<Id> vertices_;
  std::vector<Offset> row_begin_;
  std::vector<Id> rows_;
  std::vector<Offset> link_begin_;  ///< words
  std::vector<Id> links_;           ///< the places of each link, from a new word on
  std::vector<LinkRow> shapes_;     ///< of links, without their places
};

}  // namespace gale::detail
