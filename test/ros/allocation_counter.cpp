// This program counts heap calls like the one of the models.
#include "models/allocation_counter.cpp"
