#pragma once

#include <string>
#include <vector>

#include <gale/app/console.hpp>
#include <gale/app/options.hpp>
#include <gale/io/dataset.hpp>
#include <gale/mesh/segmentation.hpp>

namespace gale::app {

/// Segments the dataset's vertices as the options say: by an array, at random, or by an octree. Without options by the
/// array of segments that the input brings, else by an octree. Says which array was taken; adds a line to `notices`
/// about each that was ignored. Throws gale::Error for an array that isn't there or holds no segments.
Segmentation make_segmentation(const io::Dataset& dataset, const SegmentationOptions& options, const Console& console,
                               std::vector<std::string>& notices);

}  // namespace gale::app
