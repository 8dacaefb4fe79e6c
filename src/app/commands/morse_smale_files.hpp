#pragma once

#include <string>
#include <vector>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/app/session.hpp>

namespace gale::app {

/// The files of `gale morse-smale`. A name is empty where the file isn't wanted or nothing would be in it.
struct MorseSmaleFiles {
  std::string critical_points, separatrices1, separatrices2, segmentation;
  std::string picture;

  /// Names the files that begin with `prefix`, none if that is empty, for the parts that are wanted; and the picture.
  MorseSmaleFiles(const std::string& prefix, const MorseSmaleParts& wanted, const std::string& picture);

  std::vector<std::string> all() const;
  bool any() const;
};

/// Writes the files. `complex` may have more than is wanted: the rest is taken out of it first. Their simplices are
/// numbered as `option` says.
void write(const MorseSmaleFiles& files, const MorseSmaleParts& wanted, const FieldOnMesh& on,
           MorseSmaleComplex& complex, const StructureOption& option, Session& session, Computed& computed);

}  // namespace gale::app
