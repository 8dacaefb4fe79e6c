/**
 * @class vtkGaleAlgorithm
 * @brief what GALE's filters have in common
 *
 * The input is a vtkUnstructuredGrid or vtkStructuredGrid, whose cells of the highest dimension are split into
 * tetrahedra or triangles, a vtkPolyData, whose polygons and strips are split into triangles, or a vtkImageData or
 * vtkRectilinearGrid, of which the voxels (its points) with values above a threshold are: into six tetrahedra for each
 * cube of eight, or, where it is flat, two triangles for each square of four. It is read where it is and never changed.
 * Cells that vtkGhostType calls hidden, refined or duplicates, and cells with a hidden point, are left out, with the
 * points that no other cell has. Where no cells are left the outputs are empty. Each block of a composite dataset is a
 * mesh of its own. The field is the point array of one component that
 * SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name) names, else the active scalars, else
 * the first such array; without a name it is called "field". Where the input has an array NAME_Order beside it, the
 * vertices are ordered by that, and a warning says whether it contradicts the field.
 *
 * Kokkos is initialized by the first filter that runs, unless the program did that, and ended with the process.
 */
#ifndef vtkGaleAlgorithm_h
#define vtkGaleAlgorithm_h

#include <memory>  // for the request

#include "vtkAlgorithm.h"
#include "vtkFiltersGaleModule.h"  // for export macro

class vtkDataArray;
class vtkDataObject;

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
   * How many threads to use, at most 1024; 0, the default: as many as there are cores. The result doesn't depend on it.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, 1024);
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
   * Only voxels of an image or a rectilinear grid with values above Threshold become vertices, if UseThreshold is on;
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
   * A filter that runs an analysis (gale/outputs/analyses.hpp) and has an output port for each of its results, of
   * vtkPolyData, but for meshPort, which is a vtkUnstructuredGrid. Without an analysis that is the mesh with its
   * segments.
   */
  vtkGaleAlgorithm(const char* analysis, int outputPorts, int meshPort);
  ~vtkGaleAlgorithm() override;

  /**
   * Says by the functions below what the properties ask of the analysis.
   */
  virtual void Ask() = 0;
  void AskFlag(const char* option, bool isOn);
  void AskThreshold(const char* option, double value, bool isPercent);
  void AskChoice(const char* option, int place);  // in the order of the analysis
  void AskNumber(const char* option, int number);

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;

  int NumberOfThreads = 0;
  int Capacity = 64;
  bool UseThreshold = false;
  double Threshold = 0;

 private:
  struct Request;
  const std::unique_ptr<Request> Asked;

  vtkDataArray* SelectField(vtkInformationVector** inputs);
  int RequestData(vtkInformationVector** inputs, vtkInformationVector* outputs);

  vtkGaleAlgorithm(const vtkGaleAlgorithm&) = delete;
  void operator=(const vtkGaleAlgorithm&) = delete;
};

#endif
