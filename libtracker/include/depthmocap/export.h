#pragma once

// Marks what the library promises to its users: in the shared library only these symbols are visible.
#define DEPTHMOCAP_API __attribute__((visibility("default")))
