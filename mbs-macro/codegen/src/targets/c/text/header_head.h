#ifndef CAPS_H
#define CAPS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef SCALAR NAME_real;

