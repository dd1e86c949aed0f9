#include "simulator/scene/extend.h"
#include "simulator/scene/fields.h"

namespace aisle::sim {
namespace {

void DescribeHall(Fields& f, HallSpec& hall) {
  hall.mark = f.mark();
  f.Sentence({kUseKey,
              "file that says what is there wherever the scene does not, by its path from this "
              "file's folder or by its name among the scenes that come with the program",
              "halls/cold_store.yaml"},
             &hall.use);
  f.Point({"from", "corner with the smallest x and y", "[-5, -8]"}, &hall.from);
  f.Point({"to", "corner with the largest x and y", "[20, 8]"}, &hall.to);
  f.Number({"height_m", "floor to roof", "6.5"}, &hall.height_m, {2.2, 100});
  f.Choice({"floor", "its surface", "concrete"}, &hall.floor,
           {"concrete", "painted", "glossy", "asphalt", "resin", "blocks"});
  f.Choice({"walls", "their surface; sky: it is a place in the open", "panels"}, &hall.walls,
           {"panels", "brick", "plain", "sky", "cassettes", "insulated", "concrete"});
  f.Choice({"roof", "what carries it: trusses, steel portals, nothing that shows, concrete ribs",
            "trusses"},
           &hall.roof, {"trusses", "portal", "flat", "ribs"});
  f.Number({"wear", "how stained and scratched the floor is", "0.5"}, &hall.wear, {0, 1});
  f.Number(
      {"clutter", "how much lies about beside the ways: film, hoses, tools, puddles, chalk", "0.5"},
      &hall.clutter, {0, 1});
  f.Number({"cloud", "share of the daylight that passing clouds take at most", "0.6"}, &hall.cloud,
           {0, 0.95});
  f.Number({"cloud_s", "about from one cloud to the next", "9"}, &hall.cloud_s, {2, 600});
  DescribeHallMesh(f, hall);
}

void DescribeRack(Fields& f, RackSpec& rack) {
  rack.mark = f.mark();
  f.Point({"from", "one end of the row's centre line", "[1, 2.5]", true}, &rack.from);
  f.Degrees({"heading_deg", "direction of the row from there", "0"}, &rack.heading_rad);
  f.Integer({"bays", "side by side", "5"}, &rack.bays, {1, 60});
  f.Number({"bay_m", "width of a bay", "2.7"}, &rack.bay_m, {0.6, 6});
  f.Number({"depth_m", "front to back", "1.1"}, &rack.depth_m, {0.3, 3});
  f.Integer({"levels", "beam levels above the floor", "3"}, &rack.levels, {0, 12});
  f.Number({"level_m", "from one level to the next", "1.6"}, &rack.level_m, {0.3, 4});
  f.Number({"fill", "share of the places that are taken", "0.85"}, &rack.fill, {0, 1});
  f.Choice({"goods", "what it stores", "mixed"}, &rack.goods, kGoodsNames);
  f.Choice({"paint", "of its posts", "blue"}, &rack.paint, {"blue", "orange", "steel"});
}

void DescribeStack(Fields& f, StackSpec& stack) {
  stack.mark = f.mark();
  f.Point({"at", "middle of the pallet", "[3, 1]", true}, &stack.at);
  f.Degrees({"heading_deg", "of the pallet's long side", "90"}, &stack.heading_rad);
  f.Number({"height_m", "of the goods above the pallet", "1.2"}, &stack.height_m, {0.1, 3});
  f.Choice({"goods", "what is on it", "cartons"}, &stack.goods, kGoodsNames);
}

void DescribeColumn(Fields& f, ColumnSpec& column) {
  column.mark = f.mark();
  f.Choice({"kind", "a square post, a steel section or a round one", "square"}, &column.kind,
           {"square", "steel", "round"});
  f.Point({"at", "its middle", "[4, 1.6]", true}, &column.at);
  f.Number({"size_m", "side of its square section", "0.4"}, &column.size_m, {0.1, 2});
  f.Flag({"striped", "warning stripes up to 1.4 m", "true"}, &column.striped);
}

void DescribeMarking(Fields& f, MarkingSpec& marking) {
  marking.mark = f.mark();
  f.Choice({"kind", "a line, a hatched box, a crossing, or a pavement", "line"}, &marking.kind,
           {"line", "box", "crossing", "pavement"});
  f.Point({"from", "start of a line, corner of a box", "[0, 1.2]", true}, &marking.from);
  f.Point({"to", "end of a line, opposite corner of a box", "[14, 1.2]", true}, &marking.to);
  f.Number({"width_m", "of the line", "0.1"}, &marking.width_m, {0.02, 4});
}

void DescribeProp(Fields& f, PropSpec& prop) {
  prop.mark = f.mark();
  f.Name({"model", "file in assets/kit or assets/street without .glb", "drum", true, "mesh"},
         &prop.model);
  prop.model_mark = f.MarkOf("model");
  DescribePropMesh(f, prop);
  f.Point({"at", "where it stands", "[3, 1]", true}, &prop.at);
  f.OptionalPoint({"to", "end of a row of them that begins at `at`", "[30, 1]"}, &prop.to);
  f.Number({"every_m", "from one to the next in a row", "10"}, &prop.every_m, {0.2, 200});
  f.Degrees({"heading_deg", "where its front looks", "90"}, &prop.heading_rad);
  f.Number({"above_m", "how high above the floor it stands", "0"}, &prop.above_m, {0, 20});
}

void DescribeMezzanine(Fields& f, MezzanineSpec& mezzanine) {
  mezzanine.mark = f.mark();
  f.Point({"from", "corner with the smallest x and y", "[2, 3]", true}, &mezzanine.from);
  f.Point({"to", "corner with the largest x and y", "[9, 6]", true}, &mezzanine.to);
  f.Number({"height_m", "floor to deck", "2.8"}, &mezzanine.height_m, {2, 10});
}

void DescribeDoor(Fields& f, DoorSpec& door) {
  door.mark = f.mark();
  f.Choice({"wall", "which one: north is +y, east is +x", "east"}, &door.wall,
           {"north", "south", "east", "west"});
  f.Number({"at_m", "x or y of its middle along the wall", "0"}, &door.at_m, {-1000, 1000});
  f.Number({"width_m", "of the opening", "3"}, &door.width_m, {0.6, 20});
  f.Number({"height_m", "of the opening", "3.5"}, &door.height_m, {1.8, 20});
  f.Number({"daylight", "it stands open to a day of this radiance; 0: it is closed", "4"},
           &door.daylight, {0, 100});
}

void DescribeFixture(Fields& f, FixtureSpec& fixture) {
  fixture.mark = f.mark();
  f.Choice({"kind", "what it is", "lathe"}, &fixture.kind,
           {"strip_curtain", "panel_wall", "evaporator", "lathe", "mill", "drill", "bench",
            "tool_wall", "tool_cart", "locker", "gas_bottles", "duct", "cable_tray", "cable_drop",
            "crane", "leveller", "guide_rail"});
  f.Point({"at", "its middle", "[3, 1]", true}, &fixture.at);
  f.Degrees({"heading_deg", "where its front looks; its length lies across", "90"},
            &fixture.heading_rad);
  f.Number({"length_m", "from its left to its right; 0: as such a thing usually is", "2"},
           &fixture.length_m, {0, 200});
  f.Number({"height_m", "its top, or where it hangs; 0: as such a thing usually is", "3"},
           &fixture.height_m, {0, 50});
}

void DescribeBlackout(Fields& f, Blackout& off) {
  f.Number({"from_s", "lamps go off", "4", true}, &off.from_s, {0, 3600});
  f.Number({"to_s", "lamps come on again", "6", true}, &off.to_s, {0, 3600});
}

void DescribeLights(Fields& f, LightsSpec& lights) {
  lights.mark = f.mark();
  f.OptionalPoint({"from", "corner of the lit rectangle; absent: the hall", "[0, -2]"},
                  &lights.from);
  f.OptionalPoint({"to", "opposite corner", "[14, 2]"}, &lights.to);
  f.Integer({"rows", "side by side in y", "2"}, &lights.rows, {1, 50});
  f.Integer({"per_row", "one after another in x", "5"}, &lights.per_row, {1, 100});
  f.Number({"height_m", "above the floor", "6"}, &lights.height_m, {1.5, 100});
  f.Numbers({"size_m", "of the shining surface, along x and y", "[1.5, 0.3]"}, lights.size_m.data(),
            2, {0.05, 200});
  f.Number({"brightness",
            "radiance, 1 is a well-lit warehouse; under an open sky the first is the sky's", "1"},
           &lights.brightness, {0.001, 100});
  f.ListOf({"off", "times without light", "[{from_s: 4, to_s: 6}]"}, &lights.off, DescribeBlackout);
}

void DescribeView(Fields& f, ViewSpec& view) {
  view.mark = f.mark();
  f.Point({"at", "where the left camera stands", "[3, 1]", true}, &view.at);
  f.Degrees({"heading_deg", "where it looks, counter-clockwise from x", "90"}, &view.heading_rad);
  f.Number({"height_m", "of the camera above the floor", "1.4"}, &view.height_m, {0.05, 20});
  f.Degrees({"pitch_deg", "positive looks down", "5"}, &view.pitch_rad, {-60, 60});
}

}  // namespace

void DescribePremises(Fields& f, Premises& premises) {
  f.Group({"hall", "the building", "{from: [-5, -8], to: [20, 8]}", true},
          [&](Fields& part) { DescribeHall(part, premises.hall); });
  f.ListOf({"racks", "rows of racking", "[{from: [0, 2.5], bays: 5}]"}, &premises.racks,
           DescribeRack);
  f.ListOf({"stacks", "pallets on the floor", "[{at: [3, 1]}]"}, &premises.stacks, DescribeStack);
  f.ListOf({"columns", "of the building", "[{at: [4, 1.6]}]"}, &premises.columns, DescribeColumn);
  f.ListOf({"markings", "paint on the floor", "[{from: [0, 1], to: [14, 1]}]"}, &premises.markings,
           DescribeMarking);
  f.ListOf({"props", "pieces of the kit, one or a row", "[{model: drum, at: [3, 1]}]"},
           &premises.props, DescribeProp);
  f.ListOf({"mezzanines", "platforms on columns", "[{from: [2, 3], to: [9, 6]}]"},
           &premises.mezzanines, DescribeMezzanine);
  f.ListOf({"doors", "dock doors in the walls", "[{wall: east, at_m: 0}]"}, &premises.doors,
           DescribeDoor);
  f.ListOf({"fixtures", "machines, curtains, ducts: what else a hall has",
            "[{kind: lathe, at: [3, 1]}]"},
           &premises.fixtures, DescribeFixture);
  f.ListOf({"lights", "grids of luminaires", "[{rows: 2, per_row: 5, height_m: 6}]", true},
           &premises.lights, DescribeLights);
  f.ListOf({kViewsKey, "from where a hall is shown; a hall's file with views is a scene by itself",
            "[{at: [3, 1], heading_deg: 90}]"},
           &premises.views, DescribeView);
}

}  // namespace aisle::sim
