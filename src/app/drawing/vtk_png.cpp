#include <cerrno>

#include <vtkErrorCode.h>
#include <vtkImageResize.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderer.h>
#include <vtkWindowToImageFilter.h>

#include <gale/app/drawing/vtk_png.hpp>
#include <gale/base/error.hpp>
#include <gale/io/vtk/vtk_messages.hpp>

namespace gale::app {

vtkSmartPointer<vtkRenderWindow> make_window(int width, int height) {
  auto window = vtkSmartPointer<vtkRenderWindow>::New();
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(finer * width, finer * height);
  return window;
}

void write_png(const io::AtomicFile& file, int width, int height, const std::vector<Fill>& layers) {
  try {
    const io::detail::VtkMessages messages("VTK gave up");
    const auto window = make_window(width, height);
    window->SetNumberOfLayers(static_cast<int>(layers.size()));
    for (std::size_t i = 0; i < layers.size(); ++i) {
      vtkNew<vtkRenderer> renderer;
      renderer->SetBackground(1, 1, 1);
      renderer->SetLayer(static_cast<int>(i));
      layers[i](renderer);
      window->AddRenderer(renderer);
    }
    window->Render();
    vtkNew<vtkWindowToImageFilter> drawn;
    drawn->SetInput(window);
    drawn->ReadFrontBufferOff();
    vtkNew<vtkImageResize> picture;
    picture->SetInputConnection(drawn->GetOutputPort());
    picture->SetOutputDimensions(width, height, 1);
    vtkNew<vtkPNGWriter> writer;
    writer->SetFileName(file.temporary().c_str());
    writer->SetCompressionLevel(9);
    writer->SetInputConnection(picture->GetOutputPort());
    messages.check(vtkErrorCode::NoError);
    errno = 0;
    writer->Write();
    messages.check_written(writer->GetErrorCode());
  } catch (const std::exception& error) {
    throw Error("cannot draw '" + file.path() + "': " + error.what());
  }
}

}  // namespace gale::app
