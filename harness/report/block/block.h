#pragma once

#include <string>

#include "harness/record/results.h"

namespace aisle {

/// A part of a Markdown page that a command writes, between two lines that whoever writes the page
/// has put there:
///
///     <!-- begin nine_seeds: slam/dynamic simulator -->
///     <!-- end nine_seeds -->
///
/// The words behind the colon are the folders of the tree on which its figures hang; a house test
/// says when one of them has changed since.
struct BlockPlace {
  std::string file;   ///< the page
  std::string block;  ///< name of its part
};

/// "reports/light.md#views"; a page alone means its part `usual`. Throws InputError for a name that
/// is no word of letters, digits and underscores.
BlockPlace ParseBlockPlace(const std::string& text, const std::string& usual);

/// The page with `body` in that place; all else stays. Throws InputError, naming the file and the
/// line that is missing, unless both lines stand there once, in order.
std::string WithBlock(const std::string& page, const BlockPlace& place, const std::string& body);

/// The line under a table that says where its figures come from: the command, the program's commit,
/// the machine, the day (`when`: ISO 8601, its date is taken).
std::string BlockFoot(const Provenance& from, const std::string& command, const std::string& when);

/// Rewrites the page's part with `table` and its foot, of this program, here and now.
void WriteBlock(const BlockPlace& place, const std::string& table, const std::string& command);

}  // namespace aisle
