#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <vtkRectilinearGrid.h>
#include <vtkSmartPointer.h>

#include "fixtures.hpp"

class vtkDataObject;
class vtkGaleAlgorithm;

namespace gale::test {

/// Whatever a filter is given, each port has an output of its type; or the filter says one line, and the outputs that
/// it had before are gone.
class Inputs : public testing::Test {
 protected:
  static constexpr int n = 5;  ///< points of the grid along each axis

  Inputs() : dataset_(synthetic(n)), grid_(grid_of(dataset_)) {}

  /// Each filter, new.
  static std::vector<vtkSmartPointer<vtkGaleAlgorithm>> all();

  /// How many an output has, or its blocks have together.
  static vtkIdType points_in(vtkDataObject* output);

  /// The one line that a filter says when it has worked before and gets this then; "" if it says nothing. Checks its
  /// outputs.
  std::string line(vtkGaleAlgorithm& filter, vtkDataObject* input, const char* array = nullptr);

  /// Checks that all filters say this, "" for nothing.
  void expect_line(vtkDataObject* input, const std::string& said, const char* array = nullptr);

  /// An image whose axes are told one by one.
  vtkSmartPointer<vtkRectilinearGrid> rectilinear_of(const std::vector<double>& axis) const;

  io::Dataset dataset_;
  vtkSmartPointer<vtkUnstructuredGrid> grid_;
};

}  // namespace gale::test
