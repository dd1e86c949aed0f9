#pragma once

#include <cstddef>
#include <span>

namespace aisle {

/// How likely it is that seeds went as far wrong as these did, were nothing changed: the p of a
/// mixed distribution, of which medians and ranks see nothing while it befalls fewer than half.
///
/// `before` are the values of all old seeds, `broken` those of the new seeds that got far worse and
/// `unbroken` those of the rest; the larger the worse, on a scale on which scatter is alike
/// everywhere: errors as logarithms. For each k up to half of the seeds: the chance that k or more
/// of so many draws from the normal distribution of the old values lie beyond the k-th worst. Its
/// mean and spread are known from the old values alone, and how badly is reckoned with (for k = 1
/// this is Student's t); Bonferroni over k. Old values that hardly scatter count as scattering by a
/// tenth, or as much as those that did not break: where all of them scatter more than before, none
/// of them broke.
///
/// What no old seed has shown is therefore told even of one seed (a touch, tracking that is lost):
/// the bound holds for scatter that the old seeds show, not for a rare event that none of them met.
/// 1 where fewer than two values were there before, or none broke.
double BreakP(std::span<const double> before, std::span<const double> broken,
              std::span<const double> unbroken);

}  // namespace aisle
