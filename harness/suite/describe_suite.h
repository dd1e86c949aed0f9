#pragma once

#include "harness/suite/fields.h"
#include "harness/suite/suite.h"

namespace aisle {

/// Names every key of a suite file. `add_scene` finds a scene and adds it to the suite; it says why
/// it cannot, or nothing.
void Describe(Fields& fields, const Vocabulary& vocabulary, const Fields::Check& add_scene,
              Suite* suite);

/// A system of the list; a bare word is one of ours.
void Describe(Fields& fields, const Vocabulary& vocabulary, SystemSpec* spec);

}  // namespace aisle
