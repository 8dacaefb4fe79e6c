#pragma once

#include <string>

#include <vtkDataSet.h>
#include <vtkSmartPointer.h>

namespace gale::reader {

/// What is in a file.
struct FoundData {
  vtkSmartPointer<vtkDataSet> data;  ///< with its point arrays; nullptr if the file isn't one of that format
  std::string notice;                ///< a line on what was left out, or empty
};

/// A mesh.
FoundData read_exodus(const std::string& path);

/// A mesh or an image.
FoundData read_vtkhdf(const std::string& path);

}  // namespace gale::reader
