// The counter of the other test programs: it replaces malloc of the program it is part of.
#include "models/allocation_counter.cpp"
