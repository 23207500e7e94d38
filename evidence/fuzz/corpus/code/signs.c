double a[] = {------0.5, +-+-0.25, 1/0, -9223372036854775808/-1, 0x1p3, 1.f, 1e, .5.5};
#define
#define X
#define Y(