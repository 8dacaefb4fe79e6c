#pragma once

#include <string>

#include <gale/io/dataset.hpp>

namespace gale::perf {

/// What benchmarks run on, with float points and one float field: `grid:N` and the like, or a raw mesh, which other
/// programs read too:
///
///     int64 nV nT; float xyz[3 nV]; int32 tetrahedra[4 nT]; float field[nV]
///
/// Throws gale::Error if it can't be read.
io::Dataset make_input(const std::string& name);

}  // namespace gale::perf
