// Decimal text to float32, rounded once.
#pragma once

#include <string_view>
#include <vector>

namespace jk {

// Reads numbers parted by single blanks. Each is rounded once to the nearest float32 (through double it would be
// rounded twice); what is too large becomes an infinity, too small a zero. "nan" is read as such.
// Throws std::invalid_argument naming the position of a word that is not a number to its last character.
std::vector<float> decimals(std::string_view text);

}  // namespace jk
