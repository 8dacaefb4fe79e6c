// Draws critical points inside the volume that they were computed from, without a screen: the surface with an octant
// cut out, the volume's values on the three cut faces, and on these a small ball for each critical point, coloured by
// type.

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include <vtkActor.h>
#include <vtkBox.h>
#include <vtkCamera.h>
#include <vtkClipPolyData.h>
#include <vtkDataArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageData.h>
#include <vtkImageGaussianSmooth.h>
#include <vtkImageProperty.h>
#include <vtkImageResize.h>
#include <vtkImageSlice.h>
#include <vtkImageSliceMapper.h>
#include <vtkLegendBoxActor.h>
#include <vtkLookupTable.h>
#include <vtkMatrix4x4.h>
#include <vtkNIFTIImageReader.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRegularPolygonSource.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkTextProperty.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkWindowToImageFilter.h>
#include <vtkXMLPolyDataReader.h>

namespace {

struct Options {
  std::string volume, points, image;
  double cut[3] = {0.57, 0.5, 0.45};  // where the cut faces lie, as fractions of the volume's extent
  double surface = 55;                // the value whose surface is drawn
  double radius = 0.8;                // of a ball
  double slab = 1;                    // points at most this far in front of a cut face are drawn
  double width = 1200;                // of the picture, in pixels
};

Options parse(int argc, char** argv) {
  Options options;
  std::map<std::string, double*> numbers{{"--cut-x", options.cut},      {"--cut-y", options.cut + 1},
                                         {"--cut-z", options.cut + 2},  {"--surface", &options.surface},
                                         {"--radius", &options.radius}, {"--slab", &options.slab},
                                         {"--width", &options.width}};
  std::vector<std::string> files;
  for (int i = 1; i < argc; ++i) {
    const auto number = numbers.find(argv[i]);
    if (number != numbers.end() && i + 1 < argc) {
      *number->second = std::atof(argv[++i]);
    } else {
      files.emplace_back(argv[i]);
    }
  }
  if (files.size() != 3) {
    std::cerr << "usage: " << argv[0] << " VOLUME.nii.gz CRITICAL_POINTS.vtp IMAGE.png";
    for (const auto& [name, value] : numbers) std::cerr << " [" << name << ' ' << *value << ']';
    std::cerr << '\n';
    std::exit(2);
  }
  options.volume = files[0];
  options.points = files[1];
  options.image = files[2];
  return options;
}

struct Type {
  const char* name;
  std::array<double, 3> color;
};

// In the order of `CriticalType`.
const std::array<Type, 5> types{{{"minimum", {0.10, 0.35, 0.85}},
                                 {"1-saddle", {0.10, 0.72, 0.62}},
                                 {"2-saddle", {0.98, 0.72, 0.10}},
                                 {"maximum", {0.85, 0.12, 0.14}},
                                 {"degenerate", {0.60, 0.25, 0.70}}}};

void add_surface(vtkRenderer* renderer, vtkImageData* volume, double level, vtkImplicitFunction* octant) {
  vtkNew<vtkImageGaussianSmooth> smooth;
  smooth->SetInputData(volume);
  smooth->SetStandardDeviation(0.8);
  vtkNew<vtkFlyingEdges3D> surface;
  surface->SetInputConnection(smooth->GetOutputPort());
  surface->SetValue(0, level);
  surface->ComputeNormalsOn();
  vtkNew<vtkClipPolyData> clip;
  clip->SetInputConnection(surface->GetOutputPort());
  clip->SetClipFunction(octant);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(clip->GetOutputPort());
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.93, 0.80, 0.74);
  actor->GetProperty()->SetSpecular(0.15);
  actor->GetProperty()->SetSpecularPower(20);
  renderer->AddActor(actor);
}

// The quarter of a slice that bounds the octant: grey values, nothing where the volume is 0.
void add_cut_face(vtkRenderer* renderer, vtkImageData* volume, int axis, const int cut[3], vtkLookupTable* grey) {
  int region[6];
  volume->GetExtent(region);
  for (int a = 0; a < 3; ++a) region[2 * a] = cut[a];
  vtkNew<vtkImageSliceMapper> mapper;
  mapper->SetInputData(volume);
  mapper->SetOrientation(axis);
  mapper->SetSliceNumber(cut[axis]);
  mapper->SetCroppingRegion(region);
  mapper->CroppingOn();
  vtkNew<vtkImageSlice> slice;
  slice->SetMapper(mapper);
  slice->GetProperty()->SetLookupTable(grey);
  slice->GetProperty()->UseLookupTableScalarRangeOn();
  slice->GetProperty()->SetInterpolationTypeToCubic();
  renderer->AddViewProp(slice);
}

bool in_front_of_cut_face(const double p[3], const double corner[3], double slab) {
  const double depth[3] = {p[0] - corner[0], p[1] - corner[1], p[2] - corner[2]};
  const double nearest = std::min({depth[0], depth[1], depth[2]});
  return nearest >= 0 && nearest <= slab;
}

std::array<long, 5> add_points(vtkRenderer* renderer, vtkPolyData* critical, const double corner[3],
                               const Options& options) {
  vtkDataArray* type = critical->GetPointData()->GetArray("CriticalType");
  if (!type) {
    std::cerr << options.points << ": no point array CriticalType\n";
    std::exit(1);
  }
  std::array<long, 5> counts{};
  std::array<vtkNew<vtkPoints>, 5> points;
  for (vtkIdType i = 0; i < critical->GetNumberOfPoints(); ++i) {
    const auto t = static_cast<std::size_t>(type->GetTuple1(i));
    if (t >= types.size()) continue;
    ++counts[t];
    double p[3];
    critical->GetPoint(i, p);
    if (in_front_of_cut_face(p, corner, options.slab)) points[t]->InsertNextPoint(p);
  }
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(options.radius);
  ball->SetThetaResolution(16);
  ball->SetPhiResolution(12);
  for (std::size_t t = 0; t < types.size(); ++t) {
    vtkNew<vtkPolyData> shown;
    shown->SetPoints(points[t]);
    vtkNew<vtkGlyph3DMapper> mapper;
    mapper->SetInputData(shown);
    mapper->SetSourceConnection(ball->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(types[t].color[0], types[t].color[1], types[t].color[2]);
    actor->GetProperty()->SetAmbient(0.25);
    actor->GetProperty()->SetDiffuse(0.8);
    actor->GetProperty()->SetSpecular(0.3);
    actor->GetProperty()->SetSpecularPower(30);
    renderer->AddActor(actor);
  }
  return counts;
}

void add_legend(vtkRenderer* renderer, const std::array<long, 5>& counts) {
  vtkNew<vtkRegularPolygonSource> disc;
  disc->SetNumberOfSides(32);
  disc->Update();
  vtkNew<vtkLegendBoxActor> legend;
  legend->SetNumberOfEntries(static_cast<int>(types.size()));
  for (std::size_t t = 0; t < types.size(); ++t) {
    double color[3] = {types[t].color[0], types[t].color[1], types[t].color[2]};
    const std::string text = std::string(types[t].name) + "  " + std::to_string(counts[t]);
    legend->SetEntry(static_cast<int>(t), disc->GetOutput(), text.c_str(), color);
  }
  legend->GetEntryTextProperty()->SetColor(0.1, 0.1, 0.1);
  legend->BorderOff();
  legend->SetPosition(0.79, 0.38);
  legend->SetPosition2(0.19, 0.24);
  renderer->AddActor(legend);
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = parse(argc, argv);

  vtkNew<vtkNIFTIImageReader> volume_reader;
  volume_reader->SetFileName(options.volume.c_str());
  volume_reader->Update();
  vtkImageData* volume = volume_reader->GetOutput();
  vtkNew<vtkXMLPolyDataReader> points_reader;
  points_reader->SetFileName(options.points.c_str());
  points_reader->Update();
  if (volume_reader->GetErrorCode() || points_reader->GetErrorCode()) return 1;

  int extent[6], cut[3];
  double bounds[6], corner[3], center[3];
  volume->GetExtent(extent);
  volume->GetBounds(bounds);
  volume->GetCenter(center);
  for (int a = 0; a < 3; ++a) {
    cut[a] = extent[2 * a] + static_cast<int>(options.cut[a] * (extent[2 * a + 1] - extent[2 * a]));
    corner[a] = volume->GetOrigin()[a] + cut[a] * volume->GetSpacing()[a];
  }

  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);

  vtkNew<vtkBox> octant;
  octant->SetXMin(corner);
  octant->SetXMax(bounds[1] + 1, bounds[3] + 1, bounds[5] + 1);
  add_surface(renderer, volume, options.surface, octant);

  double range[2];
  volume->GetScalarRange(range);
  vtkNew<vtkLookupTable> grey;
  grey->SetTableRange(range);
  grey->SetSaturationRange(0, 0);
  grey->SetValueRange(0.0, 0.95);
  grey->SetNumberOfTableValues(256);
  grey->Build();
  const int outside = static_cast<int>(255 * (options.surface / 2 - range[0]) / (range[1] - range[0]));
  for (int i = 0; i < outside; ++i) grey->SetTableValue(i, 1, 1, 1, 0);
  for (int axis = 0; axis < 3; ++axis) add_cut_face(renderer, volume, axis, cut, grey);

  vtkNew<vtkTransform> to_volume;
  vtkMatrix4x4* to_world = volume_reader->GetSFormMatrix();
  if (!to_world) to_world = volume_reader->GetQFormMatrix();
  if (to_world) to_volume->SetMatrix(to_world);
  to_volume->Inverse();
  vtkNew<vtkTransformPolyDataFilter> critical;
  critical->SetInputConnection(points_reader->GetOutputPort());
  critical->SetTransform(to_volume);
  critical->Update();
  add_legend(renderer, add_points(renderer, critical->GetOutput(), corner, options));

  const double size = volume->GetLength();
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetFocalPoint(center);
  camera->SetPosition(center[0] + size, center[1] + size, center[2] + 0.8 * size);
  camera->SetViewUp(0, 0, 1);
  camera->SetViewAngle(19.5);
  camera->SetWindowCenter(0.2, -0.02);
  renderer->ResetCameraClippingRange();

  const int width = static_cast<int>(options.width), height = width * 2 / 3;
  vtkNew<vtkRenderWindow> window;  // twice as large as the picture, for smooth outlines
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(2 * width, 2 * height);
  window->AddRenderer(renderer);
  window->Render();

  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  picture->ReadFrontBufferOff();
  vtkNew<vtkImageResize> half;
  half->SetInputConnection(picture->GetOutputPort());
  half->SetOutputDimensions(width, height, 1);
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(options.image.c_str());
  writer->SetInputConnection(half->GetOutputPort());
  writer->Write();
  return writer->GetErrorCode() ? 1 : 0;
}
