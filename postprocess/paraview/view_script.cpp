// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/paraview/view_script.hpp"

#include <fmt/format.h>

#include "postprocess/views/floe_style.hpp"

namespace ice::paraview {

namespace {

// FOLDER, UNIT and STATES come before it.
constexpr const char* kScript = R"py(
import os
import sys

from paraview import simple

if "__file__" in globals():
    FOLDER = os.path.dirname(os.path.abspath(__file__))
RUN = os.path.join(FOLDER, "run.xdmf")


def part(name):
    """A reader of the part's blocks alone; None where the run has none."""
    reader = simple.XDMFReader(registrationName=name, FileNames=[RUN])
    reader.UpdatePipelineInformation()
    grids = [g for g in reader.GridStatus if g == name or g.startswith((name + "[", name + ": "))]
    if not grids:
        simple.Delete(reader)
        return None
    reader.GridStatus = grids
    return reader


def show(source, view):
    display = simple.Show(source, view)
    display.SetScalarBarVisibility(view, False)
    return display


def colour_states(display, where):
    simple.ColorBy(display, (where, "state"))
    table = simple.GetColorTransferFunction("state")
    table.InterpretValuesAsCategories = True
    table.Annotations = [word for k, (name, _) in enumerate(STATES) for word in (str(k), name)]
    table.IndexedColors = [c / 255 for _, colour in STATES for c in colour]


def build(view):
    floes, bodies, hull = part("floes"), part("bodies"), part("hull")
    contacts, water = part("contacts"), part("water")
    if floes:
        colour_states(show(floes, view), "CELLS")
    elif bodies:
        display = show(bodies, view)
        display.PointSize = 6
        colour_states(display, "POINTS")
    if hull:
        display = show(hull, view)
        simple.ColorBy(display, ("CELLS", "load_Pa"))
        display.RescaleTransferFunctionToDataRange(False)
        display.SetScalarBarVisibility(view, True)
    if contacts:
        force = "normal_force" + UNIT
        arrows = simple.Glyph(registrationName="contact forces", Input=contacts, GlyphType="Arrow")
        arrows.OrientationArray = ["POINTS", force]
        arrows.ScaleArray = ["POINTS", force]
        arrows.GlyphMode = "All Points"
        largest = largest_force(contacts, force)
        arrows.ScaleFactor = 0.1 * length_of(hull or bodies) / largest if largest > 0 else 1.0
        show(arrows, view).DiffuseColor = [0.75, 0.1, 0.1]
    if water:
        display = show(water, view)
        display.DiffuseColor = [0.3, 0.5, 0.7]
        display.Opacity = 0.3


def largest_force(contacts, name):
    times = list(contacts.TimestepValues)
    contacts.UpdatePipeline(times[-1])
    array = contacts.GetDataInformation().GetPointDataInformation().GetArrayInformation(name)
    return array.GetComponentRange(-1)[1] if array else 0.0


def length_of(source):
    source.UpdatePipeline()
    bounds = source.GetDataInformation().GetBounds()
    return max(bounds[1] - bounds[0], bounds[3] - bounds[2])


view = simple.GetActiveViewOrCreate("RenderView")
build(view)
scene = simple.GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.GoToLast()
view.ViewSize = [1200, 700]
simple.ResetCamera(view)
focus = list(view.CameraFocalPoint)
view.CameraViewUp = [0, 0, 1]
view.CameraPosition = [focus[0] + 0.6, focus[1] - 0.7, focus[2] + 0.5]
simple.ResetCamera(view)
simple.Render(view)
if len(sys.argv) > 1 and sys.argv[-1].endswith(".png"):
    simple.SaveScreenshot(sys.argv[-1], view)
)py";

std::string python_text(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        // a folder's name may hold quotes and backslashes
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + "\"";
}

}  // namespace

std::string view_script(const std::filesystem::path& folder, const std::string& force_unit) {
    std::string states;
    for (const FloeState state :
         {FloeState::held, FloeState::moving, FloeState::behind, FloeState::absent}) {
        const views::FloeStyle& style = views::floe_style(state);
        states += fmt::format("(\"{}\", ({}, {}, {})), ", style.meaning, style.color[0],
                              style.color[1], style.color[2]);
    }
    return fmt::format(
               "#!/usr/bin/env pvpython\n"
               "\"\"\"The run beside this file in ParaView: paraview --script=view.py, or "
               "pvpython view.py PICTURE.png.\"\"\"\n"
               "FOLDER = {}\nUNIT = {}\nSTATES = [{}]\n",
               python_text(std::filesystem::absolute(folder).string()), python_text(force_unit),
               states) +
           kScript;
}

}  // namespace ice::paraview
