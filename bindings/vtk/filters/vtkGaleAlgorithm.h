/**
 * @class vtkGaleAlgorithm
 * @brief what GALE's filters have in common
 *
 * The input is a vtkUnstructuredGrid whose cells of dimension 3 are tetrahedra, or a vtkImageData or
 * vtkRectilinearGrid, of which the voxels (its points) with values above a threshold are split into tetrahedra: six for
 * each cube of eight. It is read where it is and never changed. Where it has no cells the outputs are empty. Each block
 * of a composite dataset is a mesh of its own. The field is the point array of one component that
 * SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name) names, else the active scalars, else
 * the first such array. Where the input has an array NAME_Order beside it, the vertices are ordered by that.
 *
 * Kokkos is initialized by the first filter that runs, unless the program did that, and ended with the process.
 */
#ifndef vtkGaleAlgorithm_h
#define vtkGaleAlgorithm_h

#include "vtkAlgorithm.h"
#include "vtkFiltersGaleModule.h"  // for export macro

class vtkDataArray;
class vtkDataObject;

namespace gale {
namespace vtk  // so that VTK's wrappers can read it
{
class Run;
}
}  // namespace gale

class VTKFILTERSGALE_EXPORT vtkGaleAlgorithm : public vtkAlgorithm {
 public:
  vtkTypeMacro(vtkGaleAlgorithm, vtkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The input without a pipeline before it.
   */
  void SetInputData(vtkDataObject* input) { this->SetInputDataObject(input); }

  //@{
  /**
   * How many threads to use; 0, the default: as many as there are cores. The result doesn't depend on it.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfThreads, int);
  //@}

  //@{
  /**
   * How many vertices a segment of the mesh has at most; 64 by default. Results don't depend on it, but for
   * vtkGaleSegmentation.
   */
  vtkSetClampMacro(Capacity, int, 1, VTK_INT_MAX);
  vtkGetMacro(Capacity, int);
  //@}

  //@{
  /**
   * Of an image or a rectilinear grid, only voxels with values above Threshold become vertices, if UseThreshold is on;
   * all with finite values if it is off, the default.
   */
  vtkSetMacro(UseThreshold, bool);
  vtkGetMacro(UseThreshold, bool);
  vtkBooleanMacro(UseThreshold, bool);
  vtkSetMacro(Threshold, double);
  vtkGetMacro(Threshold, double);
  //@}

  vtkTypeBool ProcessRequest(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

 protected:
  /**
   * With output ports of vtkPolyData, but for meshPort, which is a vtkUnstructuredGrid.
   */
  vtkGaleAlgorithm(int outputPorts, int meshPort);
  ~vtkGaleAlgorithm() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;

  /**
   * Computes the outputs. Throws std::exception for what RequestData says by vtkErrorMacro.
   */
  virtual void Compute(gale::vtk::Run& run, vtkInformationVector* outputs) = 0;

  int NumberOfThreads = 0;
  int Capacity = 64;
  bool UseThreshold = false;
  double Threshold = 0;

 private:
  int MeshPort;

  vtkDataArray* SelectField(vtkInformationVector** inputs);
  int RequestData(vtkInformationVector** inputs, vtkInformationVector* outputs);

  vtkGaleAlgorithm(const vtkGaleAlgorithm&) = delete;
  void operator=(const vtkGaleAlgorithm&) = delete;
};

#endif
