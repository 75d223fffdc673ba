#include "no_such_header.h"  // refused: 'no_such_header.h' file not found

void missing_header() {}
