/**
 * @class vtkGaleSegmentation
 * @brief the segments that a tetrahedral mesh is divided into
 *
 * The output is the mesh with the point array ttkCompactTriangulationIndex: the segment of each point, by an octree
 * whose leaves have at most Capacity points. Localized data structures read it.
 */
#ifndef vtkGaleSegmentation_h
#define vtkGaleSegmentation_h

#include "vtkGaleAlgorithm.h"

class vtkUnstructuredGrid;

class VTKFILTERSGALE_EXPORT vtkGaleSegmentation : public vtkGaleAlgorithm {
 public:
  static vtkGaleSegmentation* New();
  vtkTypeMacro(vtkGaleSegmentation, vtkGaleAlgorithm);

  //@{
  /**
   * The mesh with its segments: port 0 is the only one.
   */
  vtkUnstructuredGrid* GetOutput();
  vtkUnstructuredGrid* GetOutput(int port);
  //@}

 protected:
  vtkGaleSegmentation();
  ~vtkGaleSegmentation() override;

  void Compute(gale::vtk::Run& run, vtkInformationVector* outputs) override;

 private:
  vtkGaleSegmentation(const vtkGaleSegmentation&) = delete;
  void operator=(const vtkGaleSegmentation&) = delete;
};

#endif
