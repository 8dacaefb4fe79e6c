#!/usr/bin/env python3
"""Draws what the gale command found in a volume, with VTK alone: the surface of the volume with an octant cut out, the
volume's values on the three cut faces, and critical points as balls, those close to a cut face; with a file of separatrices
these too, and the critical points between the faces.

usage: draw_volume.py [OPTION...] VOLUME.nii.gz IMAGE.png CRITICAL_POINTS.vtp [SEPARATRICES1.vtp]"""
import argparse

import numpy as np
from vtkmodules import vtkInteractionStyle, vtkRenderingFreeType, vtkRenderingOpenGL2  # noqa: F401, what draws
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable, vtkObject, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkBox, vtkPolyData
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkClipPolyData, vtkFlyingEdges3D, vtkSmoothPolyDataFilter, vtkThreshold, vtkTubeFilter
from vtkmodules.vtkFiltersGeneral import vtkTransformFilter
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkFiltersSources import vtkRegularPolygonSource, vtkSphereSource
from vtkmodules.vtkImagingCore import vtkImageResize
from vtkmodules.vtkImagingGeneral import vtkImageGaussianSmooth
from vtkmodules.vtkIOImage import vtkNIFTIImageReader, vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkRenderingAnnotation import vtkLegendBoxActor
from vtkmodules.vtkRenderingCore import (vtkActor, vtkGlyph3DMapper, vtkImageSlice, vtkImageSliceMapper, vtkPolyDataMapper,
                                         vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter)

TYPES = ["minima", "1-saddles", "2-saddles", "maxima", "degenerate"]  # in the order of CriticalType
COLORS = [(0.10, 0.35, 0.85), (0.10, 0.72, 0.62), (0.98, 0.72, 0.10), (0.85, 0.12, 0.14), (0.60, 0.25, 0.70)]
LINES = {0: ("lines to minima", COLORS[0]), 2: ("lines to maxima", COLORS[3])}  # by SeparatrixType


def parsed_options():
    parser = argparse.ArgumentParser(usage=__doc__.rpartition("usage: ")[2], description=__doc__.partition("\n\n")[0])
    parser.add_argument("volume")
    parser.add_argument("image")
    parser.add_argument("critical_points")
    parser.add_argument("separatrices1", nargs="?")
    parser.add_argument("--cut", nargs=3, type=float, default=(0.57, 0.5, 0.45), metavar=("X", "Y", "Z"),
                        help="where the cut faces lie, as fractions of the volume's extent")
    parser.add_argument("--surface", type=float, default=55, help="the value whose surface is drawn")
    parser.add_argument("--radius", type=float, default=0.8, help="of a ball")
    parser.add_argument("--slab", type=float, default=1, help="without separatrices: how far in front of a cut face points are drawn")
    parser.add_argument("--width", type=int, default=1200, help="of the picture, in pixels")
    return parser.parse_args()


def actor_of(mapper, color, **shading):
    """An actor of one color. Shading is of vtkProperty's: Ambient, Diffuse, Specular, SpecularPower."""
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(color)
    for name, value in shading.items():
        getattr(actor.GetProperty(), "Set" + name)(value)
    return actor


def mapper_of(filter):
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(filter.GetOutputPort())
    return mapper


def surface_without(octant, volume, value):
    """The surface of a value, without what is in an octant."""
    smooth = vtkImageGaussianSmooth()
    smooth.SetInputData(volume)
    smooth.SetStandardDeviation(0.8)
    surface = vtkFlyingEdges3D()
    surface.SetInputConnection(smooth.GetOutputPort())
    surface.SetValue(0, value)
    surface.ComputeNormalsOn()
    clip = vtkClipPolyData()
    clip.SetInputConnection(surface.GetOutputPort())
    clip.SetClipFunction(octant)
    return actor_of(mapper_of(clip), (0.93, 0.80, 0.74), Specular=0.15, SpecularPower=20)


def cut_face(volume, axis, cut, grey):
    """The quarter of a slice that bounds the octant: grey values, nothing where the volume ends."""
    region = list(volume.GetExtent())
    region[::2] = cut
    mapper = vtkImageSliceMapper()
    mapper.SetInputData(volume)
    mapper.SetOrientation(axis)
    mapper.SetSliceNumber(cut[axis])
    mapper.SetCroppingRegion(region)
    mapper.CroppingOn()
    face = vtkImageSlice()
    face.SetMapper(mapper)
    face.GetProperty().SetLookupTable(grey)
    face.GetProperty().UseLookupTableScalarRangeOn()
    face.GetProperty().SetInterpolationTypeToCubic()
    return face


def greys(volume, begin):
    """From black to white over the volume's values, but for the largest, and nothing where they are below a value."""
    values = vtk_to_numpy(volume.GetPointData().GetScalars())
    if values.max() <= max(values.min(), begin):
        raise SystemExit(f"no value of the volume is above {begin:g}, half of --surface")
    low, high = float(values.min()), float(np.percentile(values[values >= begin], 99))
    table = vtkLookupTable()
    table.SetTableRange(low, high)
    table.SetSaturationRange(0, 0)
    table.SetValueRange(0, 0.95)
    table.SetNumberOfTableValues(256)
    table.Build()
    for i in range(int(255 * (begin - low) / (high - low))):
        table.SetTableValue(i, 1, 1, 1, 0)
    return table


def in_volume(path, to_volume):
    """What a .vtp file holds, where the volume's own coordinates have it."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    moved = vtkTransformFilter()
    moved.SetInputConnection(reader.GetOutputPort())
    moved.SetTransform(to_volume)
    moved.Update()
    if reader.GetErrorCode() or not moved.GetOutput().GetNumberOfPoints():
        raise SystemExit(f"{path}: cannot be read, or has no points")
    return moved.GetOutput()


def balls(points, color, radius):
    """A ball at each of an array of points."""
    positions = vtkPoints()
    positions.SetData(numpy_to_vtk(points, deep=True))
    data = vtkPolyData()
    data.SetPoints(positions)
    ball = vtkSphereSource()
    ball.SetRadius(radius)
    ball.SetThetaResolution(16)
    ball.SetPhiResolution(12)
    mapper = vtkGlyph3DMapper()
    mapper.SetInputData(data)
    mapper.SetSourceConnection(ball.GetOutputPort())
    return actor_of(mapper, color, Ambient=0.25, Diffuse=0.8, Specular=0.3, SpecularPower=30)


def tubes_in(octant, lines, type, color, radius):
    """The separatrices of a type, smoothed, as tubes, those parts of them that are in an octant."""
    chosen = vtkThreshold()
    chosen.SetInputData(lines)
    chosen.SetInputArrayToProcess(0, 0, 0, 1, "SeparatrixType")
    chosen.SetLowerThreshold(type)
    chosen.SetUpperThreshold(type)
    chosen.SetThresholdFunction(vtkThreshold.THRESHOLD_BETWEEN)
    geometry = vtkGeometryFilter()
    geometry.SetInputConnection(chosen.GetOutputPort())
    smooth = vtkSmoothPolyDataFilter()  # they run from simplex to simplex
    smooth.SetInputConnection(geometry.GetOutputPort())
    smooth.SetNumberOfIterations(30)
    smooth.SetRelaxationFactor(0.3)
    clip = vtkClipPolyData()
    clip.SetInputConnection(smooth.GetOutputPort())
    clip.SetClipFunction(octant)
    clip.InsideOutOn()
    tube = vtkTubeFilter()
    tube.SetInputConnection(clip.GetOutputPort())
    tube.SetRadius(radius)
    tube.SetNumberOfSides(8)
    return actor_of(mapper_of(tube), color, Ambient=0.3)


def legend_of(entries):
    """A colored disc and a text for each (text, color)."""
    disc = vtkRegularPolygonSource()
    disc.SetNumberOfSides(32)
    disc.Update()
    legend = vtkLegendBoxActor()
    legend.SetNumberOfEntries(len(entries))
    for i, (text, color) in enumerate(entries):
        legend.SetEntry(i, disc.GetOutput(), text, color)
    legend.GetEntryTextProperty().SetColor(0.1, 0.1, 0.1)
    legend.BorderOff()
    legend.SetPosition(0.77, 0.5 - 0.025 * len(entries))
    legend.SetPosition2(0.21, 0.05 * len(entries))
    return legend


def main():
    options = parsed_options()
    vtkObject.GlobalWarningDisplayOff()  # what goes wrong is said below, in a line
    reader = vtkNIFTIImageReader()
    reader.SetFileName(options.volume)
    reader.Update()
    if reader.GetErrorCode():
        raise SystemExit(f"{options.volume}: cannot be read")
    volume = reader.GetOutput()
    extent, bounds = volume.GetExtent(), volume.GetBounds()
    cut = [low + int(f * (high - low)) for f, low, high in zip(options.cut, extent[::2], extent[1::2])]
    corner = [volume.GetOrigin()[axis] + cut[axis] * volume.GetSpacing()[axis] for axis in range(3)]
    octant = vtkBox()
    octant.SetXMin(corner)
    octant.SetXMax([high + 1 for high in bounds[1::2]])
    to_volume = vtkTransform()
    to_world = reader.GetSFormMatrix() or reader.GetQFormMatrix()
    if to_world:
        to_volume.SetMatrix(to_world)
    to_volume.Inverse()

    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(surface_without(octant, volume, options.surface))
    grey = greys(volume, options.surface / 2)
    for axis in range(3):
        renderer.AddViewProp(cut_face(volume, axis, cut, grey))

    critical = in_volume(options.critical_points, to_volume)
    array = critical.GetPointData().GetArray("CriticalType") or critical.GetPointData().GetArray("CellDimension")
    if not array:
        raise SystemExit(f"{options.critical_points}: no point array CriticalType or CellDimension")
    types, points = vtk_to_numpy(array), vtk_to_numpy(critical.GetPoints().GetData())
    in_front = (points - corner).min(axis=1)  # of the nearest cut face
    shown = (in_front >= 0) & ((in_front <= options.slab) | bool(options.separatrices1))
    legend = []
    for type, name in enumerate(TYPES):
        if (types == type).any():
            renderer.AddActor(balls(points[shown & (types == type)], COLORS[type], options.radius))
            legend.append((f"{(types == type).sum()} {name}", COLORS[type]))
    if options.separatrices1:
        lines = in_volume(options.separatrices1, to_volume)
        array = lines.GetCellData().GetArray("SeparatrixType")
        if not array:
            raise SystemExit(f"{options.separatrices1}: no cell array SeparatrixType")
        kinds = vtk_to_numpy(array)
        for type, (name, color) in LINES.items():
            if (kinds == type).any():
                renderer.AddActor(tubes_in(octant, lines, type, color, options.radius / 3))
                legend.append((f"{(kinds == type).sum()} {name}", color))
    renderer.AddActor(legend_of(legend))

    center, size = volume.GetCenter(), volume.GetLength()
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(center)
    camera.SetPosition(center[0] + size, center[1] + size, center[2] + 0.8 * size)
    camera.SetViewUp(0, 0, 1)
    camera.SetViewAngle(19.5)
    camera.SetWindowCenter(0.2, -0.02)
    renderer.ResetCameraClippingRange()

    width, height = options.width, options.width * 2 // 3
    window = vtkRenderWindow()  # twice as large as the picture, for smooth outlines
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(2 * width, 2 * height)
    window.AddRenderer(renderer)
    window.Render()
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    half = vtkImageResize()
    half.SetInputConnection(picture.GetOutputPort())
    half.SetOutputDimensions(width, height, 1)
    writer = vtkPNGWriter()
    writer.SetFileName(options.image)
    writer.SetInputConnection(half.GetOutputPort())
    writer.Write()
    if writer.GetErrorCode():
        raise SystemExit(f"{options.image}: cannot be written")


if __name__ == "__main__":
    main()
