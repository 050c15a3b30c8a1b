// How small a contrast eyes can tell.
#pragma once

namespace oriel {

// 1 over the amplitude, relative to the mean, of the faintest grating that an eye tells; cycles_per_degree: > 0. Of a
// wide picture (60° by 60°) of 100 cd/m², as a bright display has it (Barten 2004, "Formula for the contrast
// sensitivity of the human eye", Proc. SPIE 5294, equation for a mean observer).
double contrast_sensitivity(double cycles_per_degree);

}  // namespace oriel
