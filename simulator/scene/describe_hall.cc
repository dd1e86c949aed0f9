#include "simulator/scene/extend.h"
#include "simulator/scene/fields.h"

namespace aisle::sim {
namespace {

void DescribeHall(Fields& f, HallSpec& hall) {
  hall.mark = f.mark();
  f.Sentence({kUseKey,
              "file with the hall's content where the scene has none of its own, by its path from "
              "this file's folder or by its name among the scenes that come with the program",
              "halls/cold_store.yaml"},
             &hall.use);
  f.Point({"from", "corner with the smallest x and y", "[-5, -8]"}, &hall.from);
  f.Point({"to", "corner with the largest x and y", "[20, 8]"}, &hall.to);
  f.Number({"height_m", "height from floor to roof", "6.5"}, &hall.height_m, {2.2, 100});
  f.Choice({"floor", "surface of the floor", "concrete"}, &hall.floor,
           {"concrete", "painted", "glossy", "asphalt", "resin", "blocks"});
  f.Choice({"walls", "surface of the walls; sky: an open place without walls", "panels"},
           &hall.walls, {"panels", "brick", "plain", "sky", "cassettes", "insulated", "concrete"});
  f.Choice(
      {"roof",
       "structure that carries the roof: trusses, steel portals, nothing visible, concrete ribs",
       "trusses"},
      &hall.roof, {"trusses", "portal", "flat", "ribs"});
  f.Number({"wear", "how stained and scratched the floor is", "0.5"}, &hall.wear, {0, 1});
  f.Number({"clutter",
            "amount of things that lie beside the ways: film, hoses, tools, puddles, chalk", "0.5"},
           &hall.clutter, {0, 1});
  f.Number({"cloud", "largest share of the daylight that passing clouds take", "0.6"}, &hall.cloud,
           {0, 0.95});
  f.Number({"cloud_s", "mean time from one cloud to the next", "9"}, &hall.cloud_s, {2, 600});
  DescribeHallMesh(f, hall);
}

void DescribeRack(Fields& f, RackSpec& rack) {
  rack.mark = f.mark();
  f.Point({"from", "one end of the row's centre line", "[1, 2.5]", true}, &rack.from);
  f.Degrees({"heading_deg", "direction of the row, from `from` on", "0"}, &rack.heading_rad);
  f.Integer({"bays", "number of bays side by side", "5"}, &rack.bays, {1, 60});
  f.Number({"bay_m", "width of a bay", "2.7"}, &rack.bay_m, {0.6, 6});
  f.Number({"depth_m", "depth from front to back", "1.1"}, &rack.depth_m, {0.3, 3});
  f.Integer({"levels", "number of beam levels above the floor", "3"}, &rack.levels, {0, 12});
  f.Number({"level_m", "height from one level to the next", "1.6"}, &rack.level_m, {0.3, 4});
  f.Number({"fill", "share of the places that are occupied", "0.85"}, &rack.fill, {0, 1});
  f.Choice({"goods", "kind of goods it stores", "mixed"}, &rack.goods, kGoodsNames);
  f.Choice({"paint", "colour of its posts", "blue"}, &rack.paint, {"blue", "orange", "steel"});
}

void DescribeStack(Fields& f, StackSpec& stack) {
  stack.mark = f.mark();
  f.Point({"at", "middle of the pallet", "[3, 1]", true}, &stack.at);
  f.Degrees({"heading_deg", "direction of the pallet's long side", "90"}, &stack.heading_rad);
  f.Number({"height_m", "height of the goods above the pallet", "1.2"}, &stack.height_m, {0.1, 3});
  f.Choice({"goods", "goods on the pallet", "cartons"}, &stack.goods, kGoodsNames);
}

void DescribeColumn(Fields& f, ColumnSpec& column) {
  column.mark = f.mark();
  f.Choice({"kind", "square post, steel section or round column", "square"}, &column.kind,
           {"square", "steel", "round"});
  f.Point({"at", "middle of the column", "[4, 1.6]", true}, &column.at);
  f.Number({"size_m", "side of the square section", "0.4"}, &column.size_m, {0.1, 2});
  f.Flag({"striped", "warning stripes up to 1.4 m", "true"}, &column.striped);
}

void DescribeMarking(Fields& f, MarkingSpec& marking) {
  marking.mark = f.mark();
  f.Choice({"kind", "a line, a hatched box, a crossing, or a pavement", "line"}, &marking.kind,
           {"line", "box", "crossing", "pavement"});
  f.Point({"from", "start of a line, corner of a box", "[0, 1.2]", true}, &marking.from);
  f.Point({"to", "end of a line, opposite corner of a box", "[14, 1.2]", true}, &marking.to);
  f.Number({"width_m", "width of the line", "0.1"}, &marking.width_m, {0.02, 4});
}

void DescribeProp(Fields& f, PropSpec& prop) {
  prop.mark = f.mark();
  f.Name({"model",
          "file in assets/kit or assets/street, without .glb; routes, crowds and clutter keep "
          "clear of it",
          "drum", true, "mesh"},
         &prop.model);
  prop.model_mark = f.MarkOf("model");
  DescribePropMesh(f, prop);
  f.Point({"at", "position of the piece", "[3, 1]", true}, &prop.at);
  f.OptionalPoint({"to", "end of a row of pieces that begins at `at`", "[30, 1]"}, &prop.to);
  f.Number({"every_m", "distance from one piece to the next in the row", "10"}, &prop.every_m,
           {0.2, 200});
  f.OnlyWith("to", {"every_m"});
  f.Degrees({"heading_deg", "direction of its front", "90"}, &prop.heading_rad);
  f.Number({"above_m", "height of its foot above the floor", "0"}, &prop.above_m, {0, 20});
}

void DescribeMezzanine(Fields& f, MezzanineSpec& mezzanine) {
  mezzanine.mark = f.mark();
  f.Point({"from", "corner with the smallest x and y", "[2, 3]", true}, &mezzanine.from);
  f.Point({"to", "corner with the largest x and y", "[9, 6]", true}, &mezzanine.to);
  f.Number({"height_m", "height from floor to deck", "2.8"}, &mezzanine.height_m, {2, 10});
}

void DescribeDoor(Fields& f, DoorSpec& door) {
  door.mark = f.mark();
  f.Choice({"wall", "wall that has the door: north is +y, east is +x", "east"}, &door.wall,
           {"north", "south", "east", "west"});
  f.Number({"at_m", "x or y of the door's middle along the wall", "0"}, &door.at_m, {-1000, 1000});
  f.Number({"width_m", "width of the opening", "3"}, &door.width_m, {0.6, 20});
  f.Number({"height_m", "height of the opening", "3.5"}, &door.height_m, {1.8, 20});
  f.Number({"daylight", "radiance of the daylight behind the open door; 0: it is closed", "4"},
           &door.daylight, {0, 100});
}

void DescribeFixture(Fields& f, FixtureSpec& fixture) {
  fixture.mark = f.mark();
  f.Choice({"kind", "kind of fixture", "lathe"}, &fixture.kind,
           {"strip_curtain", "panel_wall", "evaporator", "lathe", "mill", "drill", "bench",
            "tool_wall", "tool_cart", "locker", "gas_bottles", "duct", "cable_tray", "cable_drop",
            "crane", "leveller", "guide_rail"});
  f.Point({"at", "middle of the fixture", "[3, 1]", true}, &fixture.at);
  f.Degrees({"heading_deg", "direction of its front; its length lies across", "90"},
            &fixture.heading_rad);
  f.Number({"length_m", "length from left to right; 0: usual for its kind", "2"}, &fixture.length_m,
           {0, 200});
  f.Number({"height_m", "height of its top, or at which it hangs; 0: usual for its kind", "3"},
           &fixture.height_m, {0, 50});
}

void DescribeBlackout(Fields& f, Blackout& off) {
  f.Number({"from_s", "time at which the lamps go off", "4", true}, &off.from_s, {0, 3600});
  f.Number({"to_s", "time at which the lamps come on again", "6", true}, &off.to_s, {0, 3600});
}

void DescribeLights(Fields& f, LightsSpec& lights) {
  lights.mark = f.mark();
  f.OptionalPoint({"from", "one corner of the lit rectangle; absent: that of the hall", "[0, -2]"},
                  &lights.from);
  f.OptionalPoint({"to", "opposite corner of the lit rectangle", "[14, 2]"}, &lights.to);
  f.Integer({"rows", "number of lamps side by side in y", "2"}, &lights.rows, {1, 50});
  f.Integer({"per_row", "number of lamps one after another in x", "5"}, &lights.per_row, {1, 100});
  f.Number({"height_m", "height of the lamps above the floor", "6"}, &lights.height_m, {1.5, 100});
  f.Numbers({"size_m", "size of the shining surface along x and y", "[1.5, 0.3]"},
            lights.size_m.data(), 2, {0.05, 200});
  f.Number({"brightness",
            "radiance of the lamps, where 1 is a well-lit warehouse; under an open sky, that of "
            "the first grid is the sky's",
            "1"},
           &lights.brightness, {0.001, 100});
  f.ListOf({"off", "times without light", "[{from_s: 4, to_s: 6}]"}, &lights.off, DescribeBlackout);
}

void DescribeView(Fields& f, ViewSpec& view) {
  view.mark = f.mark();
  f.Point({"at", "position of the left camera", "[3, 1]", true}, &view.at);
  f.Degrees({"heading_deg", "direction it looks in, counter-clockwise from x", "90"},
            &view.heading_rad);
  f.Number({"height_m", "height of the camera above the floor", "1.4"}, &view.height_m, {0.05, 20});
  f.Degrees({"pitch_deg", "pitch of the camera, positive down", "5"}, &view.pitch_rad, {-60, 60});
}

}  // namespace

void DescribePremises(Fields& f, Premises& premises) {
  f.Group({"hall", "the building", "{from: [-5, -8], to: [20, 8]}", true},
          [&](Fields& part) { DescribeHall(part, premises.hall); });
  f.ListOf({"racks", "rows of racking", "[{from: [0, 2.5], bays: 5}]"}, &premises.racks,
           DescribeRack);
  f.ListOf({"stacks", "pallets on the floor", "[{at: [3, 1]}]"}, &premises.stacks, DescribeStack);
  f.ListOf({"columns", "columns of the building", "[{at: [4, 1.6]}]"}, &premises.columns,
           DescribeColumn);
  f.ListOf({"markings", "markings on the floor", "[{from: [0, 1], to: [14, 1]}]"},
           &premises.markings, DescribeMarking);
  f.ListOf({"props", "pieces of the kit, single or in rows", "[{model: drum, at: [3, 1]}]"},
           &premises.props, DescribeProp);
  f.ListOf({"mezzanines", "platforms on columns", "[{from: [2, 3], to: [9, 6]}]"},
           &premises.mezzanines, DescribeMezzanine);
  f.ListOf({"doors", "dock doors in the walls", "[{wall: east, at_m: 0}]"}, &premises.doors,
           DescribeDoor);
  f.ListOf({"fixtures", "other fixtures: machines, curtains, ducts and the like",
            "[{kind: lathe, at: [3, 1]}]"},
           &premises.fixtures, DescribeFixture);
  f.ListOf({"lights", "grids of luminaires", "[{rows: 2, per_row: 5, height_m: 6}]", true},
           &premises.lights, DescribeLights);
  f.ListOf({kViewsKey,
            "views from which the hall is shown; a hall's file with views is a scene by itself",
            "[{at: [3, 1], heading_deg: 90}]"},
           &premises.views, DescribeView);
}

}  // namespace aisle::sim
