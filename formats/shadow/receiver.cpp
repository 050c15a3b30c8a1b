#include "formats/shadow/receiver.h"

namespace oriel {

ReceiverSpace::ReceiverSpace(const ShadowReceiver& receiver)
    : corner(receiver.corner), linear(glm::inverse(DMat3(receiver.x, receiver.y, receiver.normal))) {}

}  // namespace oriel
