#pragma once

#include <string>

#include <vtkDataSet.h>
#include <vtkSmartPointer.h>

namespace gale::reader {

/// The mesh of a file, with its point arrays, or nullptr if the file isn't one of that format.
vtkSmartPointer<vtkDataSet> read_exodus(const std::string& path);

/// The mesh or the image of a file, or nullptr if the file isn't one of that format.
vtkSmartPointer<vtkDataSet> read_vtkhdf(const std::string& path);

}  // namespace gale::reader
