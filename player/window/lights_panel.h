// The panel's part for lamps.
#pragma once

#include "player/session/session.h"

namespace oriel {

// Of each light group a switch, a dimmer and a colour temperature; what is set can be kept in a file for --lights.
void draw_lights(const Pack& pack, Session& session);

}  // namespace oriel
