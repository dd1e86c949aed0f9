#pragma once

#include <cstdlib>
#include <cstring>
#include <random>
#include <string>

namespace aisle::sim {

/// Of one file: the environment's AISLE_MUTANTS, for an afternoon, or as many as usual. The seed of
/// a mutant is its number.
inline int MutantsWanted(int usual) {
  const char* wanted = std::getenv("AISLE_MUTANTS");
  return wanted != nullptr ? std::atoi(wanted) : usual;
}

/// One of the numbers that parsers stumble over, in place of a digit or more of the text.
inline void MutateNumber(std::string* text, std::mt19937* random) {
  constexpr std::array<const char*, 12> kNumbers = {
      "-1",   "0",       "65536", "99999999999", "4294967295", "2147483648",
      "1e39", "-9.2e18", "1e5",   "nan",         "0.5",        ""};
  const std::size_t from = (*random)() % text->size();
  const std::size_t at = text->find_first_of("0123456789", from);
  if (at == std::string::npos) return;
  const std::size_t end = std::min(text->find_first_not_of("0123456789.", at), text->size());
  text->replace(at, end - at, kNumbers[(*random)() % kNumbers.size()]);
}

/// Bytes changed, cut out, doubled, or the rest lost.
inline void MutateBytes(std::string* text, std::mt19937* random) {
  const std::size_t at = (*random)() % text->size();
  switch ((*random)() % 6) {
    case 0:
      text->erase(at, 1 + (*random)() % 20);
      break;
    case 1:
      text->insert(at, text->substr((*random)() % text->size(), 1 + (*random)() % 40));
      break;
    case 2:
      text->resize(at);
      break;
    default:
      (*text)[at] = static_cast<char>((*random)());
  }
}

inline std::string MutatedText(std::string text, std::mt19937* random) {
  for (std::size_t edits = 1 + (*random)() % 3; edits > 0 && !text.empty(); --edits) {
    (*random)() % 3 == 0 ? MutateBytes(&text, random) : MutateNumber(&text, random);
  }
  return text;
}

inline std::uint32_t WordAt(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof(word));
  return word;
}

inline void SetWord(std::string* bytes, std::size_t at, std::size_t word) {
  const auto value = static_cast<std::uint32_t>(word);
  std::memcpy(bytes->data() + at, &value, sizeof(value));
}

/// A third each: any bytes, numbers of the JSON with the chunk lengths made right again, words of
/// the binary chunk.
inline std::string MutatedGlb(std::string glb, std::mt19937* random) {
  const std::size_t json_size = WordAt(glb, 12);
  switch ((*random)() % 3) {
    case 0:
      MutateBytes(&glb, random);
      return glb;
    case 1: {
      std::string json = glb.substr(20, json_size);
      MutateNumber(&json, random);
      glb.replace(20, json_size, json);
      SetWord(&glb, 12, json.size());
      SetWord(&glb, 8, glb.size());
      return glb;
    }
    default: {
      const std::size_t words = (glb.size() - 28 - json_size) / 4;
      SetWord(&glb, 28 + json_size + 4 * ((*random)() % words), (*random)());
      return glb;
    }
  }
}

/// A model with a material library, faces in every way of writing them, and a line.
inline constexpr const char* kObj =
    "mtllib m.mtl\no thing\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nv 0.5 0.5 1\nvt 0 0\nvt 1 0\n"
    "vt 1 1\nvn 0 0 1\nvn 0 1 0\nusemtl grey\ns 1\nf 1/1/1 2/2/1 3/3/2\nf 1//1 3//1 4//2\n"
    "g other\nusemtl dark\nf 1 2 5\nf -1 -2 -3\nl 1 2\nf 1/1 2/2 3/3 4/1\n";
inline constexpr const char* kMtl =
    "newmtl grey\nKd 0.25 0.25 0.25\nKe 0 0 0\nNs 10\nd 1\nillum 2\nnewmtl dark\n"
    "Kd 0.1 0.1 0.1\nKs 0.5 0.5 0.5\n";

/// A skinned and animated quad, shown by a node of a library as well.
inline constexpr const char* kCollada = R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
 <source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array>
  <technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/>
  <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
 <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
 <polylist count="1"><input semantic="VERTEX" source="#v" offset="0"/>
  <vcount>4</vcount><p>0 1 2 3</p></polylist>
</mesh></geometry></library_geometries>
<library_controllers><controller id="c"><skin source="#g">
 <bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix>
 <source id="j"><Name_array id="ja" count="2">low high</Name_array><technique_common>
  <accessor source="#ja" count="2"><param name="JOINT" type="name"/></accessor></technique_common>
 </source>
 <source id="b"><float_array id="ba" count="32">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 1 0 0 0 0 1 0 -1 0 0 1 0 0 0 0 1</float_array>
  <technique_common><accessor source="#ba" count="2" stride="16">
  <param name="TRANSFORM" type="float4x4"/></accessor></technique_common></source>
 <source id="w"><float_array id="wa" count="2">1 0.5</float_array><technique_common>
  <accessor source="#wa" count="2"><param name="WEIGHT" type="float"/></accessor>
  </technique_common></source>
 <joints><input semantic="JOINT" source="#j"/><input semantic="INV_BIND_MATRIX" source="#b"/></joints>
 <vertex_weights count="4"><input semantic="JOINT" source="#j" offset="0"/>
  <input semantic="WEIGHT" source="#w" offset="1"/><vcount>1 1 2 2</vcount>
  <v>0 0 0 0 0 1 1 1 0 1 1 1</v></vertex_weights>
</skin></controller></library_controllers>
<library_nodes><node id="spare"><instance_geometry url="#g"/></node></library_nodes>
<library_animations><animation id="a">
 <source id="t"><float_array id="ta" count="2">0 1</float_array><technique_common>
  <accessor source="#ta" count="2"><param name="TIME" type="float"/></accessor></technique_common>
 </source>
 <source id="o"><float_array id="oa" count="6">0 1 0 0 2 0</float_array><technique_common>
  <accessor source="#oa" count="2" stride="3"><param name="X" type="float"/>
  <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
 <source id="i"><Name_array id="ia" count="2">LINEAR LINEAR</Name_array><technique_common>
  <accessor source="#ia" count="2"><param name="INTERPOLATION" type="name"/></accessor>
  </technique_common></source>
 <sampler id="s"><input semantic="INPUT" source="#t"/><input semantic="OUTPUT" source="#o"/>
  <input semantic="INTERPOLATION" source="#i"/></sampler>
 <channel source="#s" target="high/place"/>
</animation></library_animations>
<library_visual_scenes><visual_scene id="vs">
 <node id="low" sid="low" name="low" type="JOINT"><node id="high" sid="high" name="high" type="JOINT">
  <translate sid="place">0 1 0</translate></node></node>
 <node id="shown"><instance_controller url="#c"><skeleton>#low</skeleton></instance_controller></node>
 <node id="again"><translate>3 0 0</translate><instance_node url="#spare"/></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#vs"/></scene>
</COLLADA>
)";

}  // namespace aisle::sim
