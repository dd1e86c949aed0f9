#pragma once

#include <string>
#include <vector>

#include "harness/record/results.h"

namespace aisle {

/// What the runs say, in a few sentences, worst first: how far each system is off on the scenes as
/// written (medians over seeds of ATE), and how much each rejection wins back of what movers cost
/// the same system without it. An error of less than whole drives (AreWholeDrives) says of how
/// much it is, and of how many runs, and wins nothing back. Of a scene whose vehicle the systems
/// steer it says where that ended (DriveSentence). Empty where no run has an ATE or steers.
///
///   On paper/scene2, plain is off by 1.69 m, robust by 5.1 mm and oracle by 4.3 mm: robust wins
///   back 99.7 % of what movers cost plain.
std::vector<std::string> AnswerInWords(const Results& results);

/// The suite's name as a heading: of more than three driven together, whose names are joined by
/// "+", the first two and how many more.
std::string ReportTitle(const Results& results);

/// "1.69 m", "2.5 cm", "0.4 mm": two or three figures from a millimetre on, in the unit that people
/// would use.
std::string LengthInWords(double metres);

}  // namespace aisle
