#pragma once

#include <cstddef>

#include <gale/export.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/relations/relation.hpp>
#include <gale/runtime/structure_options.hpp>

namespace gale::detail {

inline constexpr std::size_t mebibyte = std::size_t(1) << 20;

/// An option, or what it is where it was left open (0). Throws gale::Error, naming it, if it is below 0.
int given_or(int given, int otherwise, const char* name);

/// Throws gale::Error if a structure is to be preconditioned for nothing.
GALE_EXPORT void require_relations(RelationSet wanted);

/// A guess for the first batch: words that the blocks of a regular mesh take for each vertex.
double words_per_vertex(RelationSet relations);

/// What StructureOptions come to for one of the queues, with what they leave open filled in.
struct Sizes {
  Offset batch_words = 0;      ///< room of a batch, and of the arena that takes its blocks
  std::size_t host_bytes = 0;  ///< budget of arenas
  Id segments_per_request = 1;
  int threads_per_segment = 0;
};

/// Throws gale::Error for an option below 0, whichever way looks at it.
void require_counts(const StructureOptions& options);

/// Finds these for each of `queues` queues. Throws gale::Error for an option below 0.
Sizes sizes_for(const Mesh& mesh, const StructureOptions& options, int queues);

/// Bytes for blocks on the host, of all queues or helpers together.
std::size_t host_memory(const StructureOptions& options);

/// The cores of a sweep, for consumers and helpers. Throws gale::Error for an option below 0.
int cores(const StructureOptions& options);

}  // namespace gale::detail
