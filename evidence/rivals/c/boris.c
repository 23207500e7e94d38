/* Boris' method for a charge in the plane: the error of the energy, for docs/magnetic-fields.md.

       gcc -O2 boris.c -o boris -lm && ./boris gentle 0.2 1e7

   B = 1 + (x^2 + y^2)/4 and E = -grad U. U is (x^3 - y^3 + x^4 + y^4)/50, of the scene drift-in-a-gradient ("gentle"), or
   (x^3 - y^3 + x^4/5 + y^4)/10 ("strong"); x = (0, 1), v = (1/10, 1/2). A gyration takes 2 pi. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static double scale, quartic;

static double potential(double x, double y) { return (x * x * x - y * y * y + quartic * x * x * x * x + y * y * y * y) / scale; }

static void push(double x, double y, double h, double *vx, double *vy) {
    double ex = -(3 * x * x + 4 * quartic * x * x * x) / scale, ey = (3 * y * y - 4 * y * y * y) / scale;
    double t = (1 + (x * x + y * y) / 4) * h / 2, s = 2 * t / (1 + t * t);
    double mx = *vx + h / 2 * ex, my = *vy + h / 2 * ey;
    double px = mx + my * t, py = my - mx * t;
    *vx = mx + py * s + h / 2 * ex;
    *vy = my - px * s + h / 2 * ey;
}

int main(int argc, char **argv) {
    if (argc != 4) return fprintf(stderr, "boris gentle|strong STEP GYRATIONS\n"), 2;
    int strong = strcmp(argv[1], "strong") == 0;
    scale = strong ? 10 : 50, quartic = strong ? 0.2 : 1;
    double h = atof(argv[2]), x = 0, y = 1, vx = 0.1, vy = 0.5, largest = 0;
    long steps = (long)(atof(argv[3]) * 2 * M_PI / h), part = steps / 10;
    double start = (vx * vx + vy * vy) / 2 + potential(x, y);
    push(x, y, -h / 2, &vx, &vy); /* velocities are half a step behind positions */
    for (long n = 1; n <= steps; n++) {
        double ux = vx, uy = vy;
        push(x, y, h, &vx, &vy);
        double cx = (ux + vx) / 2, cy = (uy + vy) / 2, error = (cx * cx + cy * cy) / 2 + potential(x, y) - start;
        if (!(fabs(error) <= largest)) largest = fabs(error);
        x += h * vx, y += h * vy;
        if (n % part == 0) printf("%.2e gyrations: error of H %.3g, largest %.3g\n", n * h / (2 * M_PI), error, largest);
    }
}
