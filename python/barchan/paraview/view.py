"""A run in ParaView: the grains as spheres of their size, clumps as theirs, the flow in a vertical plane behind them.

Without a window, a picture of one time:

    pvbatch python/barchan/paraview/view.py RUN_DIR OUT.png [TIME [QUANTITY]]

TIME in seconds, by default the last. QUANTITY colours the grains: height (default), or what grains.h5 holds:
d, u, omega, force_drag, ...; of a vector the magnitude. Without a display put `xvfb-run -a` before it.

In the program itself: File > Load State, this file, after setting RUN below or starting ParaView with

    BARCHAN_RUN=runs/barchan-10k paraview

or, with grains.xdmf or fields.xdmf open, Run Script in the Python Shell. docs/results.md
says what the pipeline does, step by step. Written for ParaView 5.11.
"""

import os
import sys

import numpy as np
from paraview import servermanager
from paraview import simple as pv
from vtkmodules.util.numpy_support import vtk_to_numpy

RUN = os.environ.get("BARCHAN_RUN", "")  # the run folder, when the script is loaded as a state
QUANTITY = os.environ.get("BARCHAN_QUANTITY", "height")

PICTURE = (1400, 788)     # [pixels]
MANY = 50_000             # above so many grains spheres are drawn as impostors, not as polygons
WIDTH_IN_VIEW = 0.02     # [m], what the camera sees of a dune at least
BATCH = len(sys.argv) > 1  # the program itself has no arguments for a script
UNITS = {"height": "mm", "d": "m", "u": "m/s", "omega": "rad/s", "id": ""}


def stop(sentence):
    """Ends pvbatch with one line, exit code 2 for bad input; in the program it is a message."""
    if not BATCH:
        raise RuntimeError(sentence)
    print(f"paraview_view: {sentence}", file=sys.stderr)
    sys.stderr.flush()
    os._exit(2)  # pvbatch shows a traceback for SystemExit


# --- the data ----------------------------------------------------------------------------------------


def open_series(path):
    """A time series by the reader "XDMF Reader"."""
    reader = pv.XDMFReader(registrationName=os.path.basename(path), FileNames=[path])
    reader.UpdatePipelineInformation()
    return reader


def find_open(name):
    """A reader of that file that is open in the program already, or None."""
    for source in pv.GetSources().values():
        files = getattr(source, "FileNames", None) or getattr(source, "FileName", None) or []
        files = [files] if isinstance(files, str) else files  # XDMF Reader has several, Xdmf3 Reader one
        if any(os.path.basename(str(path)) == name for path in files):
            return source
    return None


def readers(folder):
    """(grains, fields) of a run folder, each None when the run has none; of what is open without a folder."""
    result = []
    for name in ("grains.xdmf", "fields.xdmf"):
        path = os.path.join(folder, name)
        if not folder:
            result.append(find_open(name))
        else:
            result.append(open_series(path) if os.path.exists(path) else None)
    return result


def nearest_time(reader, wanted):
    """The stored time nearest to `wanted` (None: the last) [s]."""
    times = reader.TimestepValues
    times = list(times) if hasattr(times, "__len__") else [times]  # a single one is a number
    return times[-1] if wanted is None else min(times, key=lambda time: abs(time - wanted))


# --- the grains --------------------------------------------------------------------------------------


# The script of a filter that puts the spheres of clumps in the place of these. Tables of all kinds, of a clump of
# diameter 1: kind (M), centre (M, 3), radius (M). ParaView runs it among the names of this file and adds its own, of
# which some hide those of Python.
SPHERES = """
import numpy as np
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.util.numpy_support import numpy_to_vtk

table_kind, centre, radius = np.array({kind}), np.array({centre}), np.array({radius})
grains = inputs[0].PointData
d, q = np.asarray(grains["d"]), np.asarray(grains["orientation"]).reshape(-1, 4)
kind = np.asarray(grains["kind"]) if "kind" in grains.keys() else np.zeros(len(d), int)
count = np.bincount(table_kind)
of_each, first = count[kind], (np.cumsum(count) - count)[kind]
grain = np.repeat(np.arange(len(d)), of_each)
sphere = first[grain] + np.arange(len(grain)) - np.repeat(np.cumsum(of_each) - of_each, of_each)
w, u, v = q[grain, :1], q[grain, 1:], centre[sphere]
across = 2 * np.cross(u, v)
x = np.asarray(inputs[0].Points)[grain] + d[grain, None] * (v + w * across + np.cross(u, across))
points = vtkPoints()
points.SetData(numpy_to_vtk(np.ascontiguousarray(x), deep=True))
output.SetPoints(points)
for name in grains.keys():
    if name != "orientation":
        output.PointData.append(np.ascontiguousarray(np.asarray(grains[name])[grain]), name)
output.PointData.append(2 * d[grain] * radius[sphere], "d")
for name in ("abs", "all", "any", "max", "min", "round", "sum"):
    globals().pop(name, None)
"""


def shapes_of(reader):
    """{"kind", "centre", "radius": lists} of the spheres of clumps in the file of the reader; None: all are spheres."""
    if "orientation" not in reader.PointData.keys():
        return None
    try:
        import h5py
    except ImportError:
        print("paraview_view: no h5py: clumps are drawn as spheres of their volume", file=sys.stderr)
        return None
    files = getattr(reader, "FileNames", None) or reader.FileName
    path = files if isinstance(files, str) else files[0]
    os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")
    with h5py.File(os.path.splitext(path)[0] + ".h5") as file:
        return {name: file["spheres"][name][:].tolist() for name in ("kind", "centre", "radius")}


def show_grains(reader, view, quantity):
    """Spheres of diameter d, those of clumps in their places, coloured by `quantity`."""
    source = reader
    shapes = shapes_of(reader)
    if shapes is not None:
        source = pv.ProgrammableFilter(registrationName="spheres of clumps", Input=reader)
        source.OutputDataSetType = "vtkPolyData"
        source.Script = SPHERES.format(**shapes)
    if quantity == "height":
        source = pv.Calculator(registrationName="height", Input=source)
        source.ResultArrayName = "height"
        source.Function = "1000 * coordsY"
    source.UpdatePipeline()
    if quantity not in source.PointData.keys():
        stop(f'no "{quantity}" in grains.h5; it has {", ".join(sorted(reader.PointData.keys()))}, and height')
    many = source.GetDataInformation().GetNumberOfPoints() > MANY
    shown = source if many else spheres(source)
    display = pv.Show(shown, view)
    display.Ambient = 0.25
    if many:
        as_impostors(display)
    colour(display, view, quantity, source.PointData[quantity], "Viridis (matplotlib)", 0.66)
    return source


def spheres(source):
    glyphs = pv.Glyph(registrationName="spheres", Input=source, GlyphType="Sphere")
    glyphs.GlyphType.Radius = 0.5           # diameter 1, times d
    glyphs.GlyphType.ThetaResolution = 12
    glyphs.GlyphType.PhiResolution = 8
    glyphs.OrientationArray = ["POINTS", "No orientation array"]
    glyphs.ScaleArray = ["POINTS", "d"]
    glyphs.ScaleFactor = 1.0
    glyphs.GlyphMode = "All Points"         # the default shows a sample of 5,000
    return glyphs


def as_impostors(display):
    """Point Gaussian: a shaded disc per grain, for any number of them."""
    display.SetRepresentationType("Point Gaussian")
    display.ShaderPreset = "Sphere"
    display.ScaleByArray = 1
    display.SetScaleArray = ["POINTS", "d"]
    display.UseScaleFunction = 0
    display.GaussianRadius = 0.5


# --- the flow ----------------------------------------------------------------------------------------


def show_flow(reader, view, z):
    """u in the plane `z` [m]."""
    points = pv.CellDatatoPointData(registrationName="at the corners", Input=reader)  # smooth colours
    plane = pv.Slice(registrationName="plane of the flow", Input=points, SliceType="Plane")
    plane.SliceType.Origin = [0.0, 0.0, z]
    plane.SliceType.Normal = [0.0, 0.0, 1.0]
    display = pv.Show(plane, view)
    display.Ambient, display.Diffuse, display.Specular = 1.0, 0.0, 0.0  # colours as in the bar, no shading
    plane.UpdatePipeline()
    colour(display, view, "u of the water", plane.PointData["u"], "Cividis", 0.14, name="u")
    return plane


# --- colours, floor, camera --------------------------------------------------------------------------


def colour(display, view, title, array, preset, place, name=None):
    """Colours by an array over its range; a vector by its magnitude. `place` of the bar from the left."""
    name = name or title
    vector = array.GetNumberOfComponents() > 1
    pv.ColorBy(display, ("POINTS", name, "Magnitude") if vector else ("POINTS", name), separate=True)
    table = pv.GetColorTransferFunction(name, display, separate=True)
    table.ApplyPreset(preset, True)
    low, high = array.GetRange(-1 if vector else 0)
    low = 0.0 if 0.0 <= low < 0.2 * high else low
    table.RescaleTransferFunction(0.0 if vector else low, high if high > low else low + 1e-12)
    bar = pv.GetScalarBar(table, view)
    unit = UNITS.get(name, "N" if name.startswith("force") else "")
    bar.Title = title + (f" ({unit})" if unit else "")
    bar.ComponentTitle = ""
    bar.Orientation, bar.WindowLocation, bar.Position = "Horizontal", "Any Location", [place, 0.05]
    bar.ScalarBarLength, bar.ScalarBarThickness = 0.2, 12
    bar.TitleColor = bar.LabelColor = [0.0, 0.0, 0.0]
    bar.TitleFontSize, bar.LabelFontSize = 18, 16
    bar.AutomaticLabelFormat, bar.LabelFormat, bar.RangeLabelFormat = 0, "%.3g", "%.2g"
    display.SetScalarBarVisibility(view, True)


def show_floor(bounds, view):
    """A plate under the channel; bounds of x, y, z [m]."""
    x0, x1, _, _, z0, z1 = bounds
    floor = pv.Plane(registrationName="floor", Origin=[x0, 0, z0], Point1=[x1, 0, z0], Point2=[x0, 0, z1])
    display = pv.Show(floor, view)
    display.DiffuseColor = display.AmbientColor = [0.85, 0.85, 0.83]
    display.Ambient = 0.2


def middle(source):
    """The median place and the extent of most grains along x, y, z [m]."""
    data = servermanager.Fetch(source)
    while data.IsA("vtkMultiBlockDataSet"):
        data = data.GetBlock(0)
    x = vtk_to_numpy(data.GetPoints().GetData())
    low, centre, high = np.percentile(x, [3, 50, 97], axis=0)
    return centre, high - low


def aim(view, centre, width):
    """From above and a little upstream of the left of the picture; y is up."""
    distance = width / 2.0 / 0.27  # half the view angle of 30 degrees
    view.CameraFocalPoint = [centre[0], 0.06 * width, centre[2]]
    view.CameraPosition = [centre[0] - 0.35 * distance, 0.45 * distance, centre[2] + 0.82 * distance]
    view.CameraViewUp = [0.0, 1.0, 0.0]
    view.CenterOfRotation = view.CameraFocalPoint


def new_view():
    view = pv.GetActiveViewOrCreate("RenderView")
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = "Single Color"
    view.Background = [1.0, 1.0, 1.0]
    view.OrientationAxesLabelColor = [0.0, 0.0, 0.0]
    return view


def show_time(reader, view):
    note = pv.AnnotateTimeFilter(registrationName="time", Input=reader, Format="t = {time:.3g} s")
    display = pv.Show(note, view)
    display.Color, display.FontSize, display.WindowLocation = [0.0, 0.0, 0.0], 20, "Upper Left Corner"


def build(folder, wanted, quantity):
    """The whole pipeline; returns the view."""
    grains, fields = readers(folder)
    if grains is None and fields is None:
        stop(f"no grains.xdmf and no fields.xdmf in {folder}" if folder else
             "set RUN in this file or BARCHAN_RUN to the run folder, or open grains.xdmf first")
    pv._DisableFirstRenderCameraReset()  # ours is to stay; saved states call it, too
    view = new_view()
    time = nearest_time(grains or fields, wanted)
    scene = pv.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.AnimationTime = view.ViewTime = time
    for reader in filter(None, (grains, fields)):
        reader.UpdatePipeline(time)
    box = (fields or grains).GetDataInformation().GetBounds()
    centre = [0.5 * (box[0] + box[1]), 0.0, 0.5 * (box[4] + box[5])]
    spread = [box[1] - box[0], 0.0, 0.0]
    if grains is not None:
        centre, spread = middle(show_grains(grains, view, quantity))
    if fields is not None:
        show_flow(fields, view, centre[2] - 0.55 * spread[2])  # behind the dune, not to hide it
    show_floor(box, view)
    show_time(grains or fields, view)
    aim(view, centre, max(WIDTH_IN_VIEW if grains is not None else 0.0, 1.3 * spread[0]))
    return view


def main(arguments):
    if len(arguments) not in (2, 3, 4):
        stop("RUN_DIR OUT.png [TIME [QUANTITY]]")
    folder, picture = arguments[:2]
    try:
        wanted = float(arguments[2]) if len(arguments) > 2 else None
    except ValueError:
        stop(f'TIME is a number of seconds, not "{arguments[2]}"')
    view = build(folder, wanted, arguments[3] if len(arguments) > 3 else "height")
    view.ViewSize = PICTURE
    pv.SaveScreenshot(picture, view, ImageResolution=PICTURE, OverrideColorPalette="WhiteBackground")
    print(picture)


if BATCH:
    main(sys.argv[1:])
else:
    pv.Render(build(RUN, None, QUANTITY))
