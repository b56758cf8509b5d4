#include "inkgrid/options.h"
