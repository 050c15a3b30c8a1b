// Is compiled for its precompiled header alone.
