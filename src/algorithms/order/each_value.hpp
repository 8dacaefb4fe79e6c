#pragma once

/// instantiate(Value) for each type of value that a VertexOrder is made from: what is a template over it is
/// instantiated with it in its source.
#define GALE_FOR_EACH_VALUE(instantiate) \
  instantiate(char);                     \
  instantiate(signed char);              \
  instantiate(unsigned char);            \
  instantiate(short);                    \
  instantiate(unsigned short);           \
  instantiate(int);                      \
  instantiate(unsigned int);             \
  instantiate(long);                     \
  instantiate(unsigned long);            \
  instantiate(long long);                \
  instantiate(unsigned long long);       \
  instantiate(float);                    \
  instantiate(double)
