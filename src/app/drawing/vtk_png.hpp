#pragma once

#include <functional>

#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include <gale/io/atomic_file.hpp>

class vtkRenderer;

namespace gale::app {

/// Pictures are drawn so many times as large and made smaller, for smooth outlines.
constexpr int finer = 2;

/// For a picture of that size, without a window on the screen.
vtkSmartPointer<vtkRenderWindow> make_window(int width, int height);

/// Draws on white what `fill` adds to the renderer, and writes it as a PNG. Throws gale::Error.
void write_png(const io::AtomicFile& file, int width, int height, const std::function<void(vtkRenderer*)>& fill);

}  // namespace gale::app
