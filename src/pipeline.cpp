#include "pipeline.h"
namespace inkgrid { const char* version() { return "0.1.0"; } }
