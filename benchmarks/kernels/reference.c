/* Kernels specialised for one mechanism each, as somebody would write them who has only this mechanism:
   unit vectors instead of angles, one root and one division per dyad, structure of arrays.
   Reference for the benchmark only. */
#include <math.h>

typedef struct { double x, y; } vec;

/* Everything of an RRR dyad between the moving pin P and the fixed pin Q. */
typedef struct {
    vec u, w;                 /* B-P, B-Q */
    double w1, w2, e1, e2;    /* rates of both links */
    double inv;               /* -1/((B-P)x(B-Q)) */
} dyad;

static inline __attribute__((always_inline)) dyad solve_dyad(
    double px, double py, double vx, double vy, double ax, double ay,
    double qx, double qy, double r4, double k, double sign)
{
    dyad o;
    double dx = qx - px, dy = qy - py, d2 = dx * dx + dy * dy, t = d2 + k;
    double root = sqrt(r4 * d2 - t * t), one = 1.0 / (d2 * root), half = 0.5 * one * root;
    double along = t * half, across = sign * root * half;
    o.inv = -2.0 * sign * one * d2;
    o.u.x = along * dx - across * dy;
    o.u.y = along * dy + across * dx;
    o.w.x = o.u.x - dx;
    o.w.y = o.u.y - dy;
    o.w1 = (vx * o.w.x + vy * o.w.y) * o.inv;
    o.w2 = (vx * o.u.x + vy * o.u.y) * o.inv;
    double s1 = o.w1 * o.w1, s2 = o.w2 * o.w2;
    double gx = ax - s1 * o.u.x + s2 * o.w.x, gy = ay - s1 * o.u.y + s2 * o.w.y;
    o.e1 = (gx * o.w.x + gy * o.w.y) * o.inv;
    o.e2 = (gx * o.u.x + gy * o.u.y) * o.inv;
    return o;
}

/* p: a w d b c sign px py */
#define FOURBAR(C, S) \
    double ax = a * (C), ay = a * (S), vx = -w * ay, vy = w * ax, bx = -w * w * ax, by = -w * w * ay; \
    dyad o = solve_dyad(ax, ay, vx, vy, bx, by, d, 0.0, r4, k, sign); \
    double rx = pu * o.u.x - pv * o.u.y, ry = pu * o.u.y + pv * o.u.x, q = o.w1 * o.w1, q2 = o.w2 * o.w2;

#define FOURBAR_DESIGN(p) \
    const double a = (p)[0], w = (p)[1], d = (p)[2], b = (p)[3], c = (p)[4], sign = (p)[5]; \
    const double r4 = 4 * b * b, k = b * b - c * c, pu = (p)[6] / b, pv = (p)[7] / b;

void fourbar(long n, const double *restrict C, const double *restrict S, const double *restrict p,
             double *restrict out)
{
    FOURBAR_DESIGN(p)
    #pragma omp simd
    for (long i = 0; i < n; i++) {
        FOURBAR(C[i], S[i])
        out[i] = ax;                        out[n + i] = ay;
        out[2 * n + i] = ax + o.u.x;        out[3 * n + i] = ay + o.u.y;
        out[4 * n + i] = ax + rx;           out[5 * n + i] = ay + ry;
        out[6 * n + i] = vx;                out[7 * n + i] = vy;
        out[8 * n + i] = -o.w2 * o.w.y;     out[9 * n + i] = o.w2 * o.w.x;
        out[10 * n + i] = vx - o.w1 * ry;   out[11 * n + i] = vy + o.w1 * rx;
        out[12 * n + i] = bx;               out[13 * n + i] = by;
        out[14 * n + i] = -o.e2 * o.w.y - q2 * o.w.x;
        out[15 * n + i] = o.e2 * o.w.x - q2 * o.w.y;
        out[16 * n + i] = bx - o.e1 * ry - q * rx;
        out[17 * n + i] = by + o.e1 * rx - q * ry;
        out[18 * n + i] = o.w1;             out[19 * n + i] = o.w2;
        out[20 * n + i] = o.e1;             out[21 * n + i] = o.e2;
    }
}

/* per design: min of the square of the sine of the transmission angle (as |u x w|²), max |v_P|², max |a_P|²,
   max w2², max e2² */
void fourbar_sweep(long designs, long n, const double *restrict C, const double *restrict S,
                   const double *restrict table, double *restrict out)
{
    for (long j = 0; j < designs; j++) {
        FOURBAR_DESIGN(table + 8 * j)
        double m0 = 1e300, m1 = -1e300, m2 = -1e300, m3 = -1e300, m4 = -1e300;
        #pragma omp simd reduction(min : m0) reduction(max : m1, m2, m3, m4)
        for (long i = 0; i < n; i++) {
            FOURBAR(C[i], S[i])
            double cross = o.u.x * o.w.y - o.u.y * o.w.x, t = cross * cross;
            double v1 = vx - o.w1 * ry, v2 = vy + o.w1 * rx;
            double a1 = bx - o.e1 * ry - q * rx, a2 = by + o.e1 * rx - q * ry;
            double vv = v1 * v1 + v2 * v2, aa = a1 * a1 + a2 * a2, ee = o.e2 * o.e2;
            m0 = t < m0 ? t : m0;
            m1 = vv > m1 ? vv : m1;
            m2 = aa > m2 ? aa : m2;
            m3 = q2 > m3 ? q2 : m3;
            m4 = ee > m4 ? ee : m4;
        }
        double *o = out + 5 * j;
        o[0] = m0; o[1] = m1; o[2] = m2; o[3] = m3; o[4] = m4;
    }
}

/* Forces of a dyad with the mass centres at mid-length; l: further load on pin B, taken by link 2. */
typedef struct { vec p, b, q; } pins;

static inline __attribute__((always_inline)) pins dyad_forces(
    dyad o, double ax, double ay, double bx, double by, double m1, double j1, double m2, double j2, double g,
    double lx, double ly)
{
    double f1x = 0.5 * m1 * (ax + bx), f1y = m1 * (0.5 * (ay + by) + g);
    double f2x = 0.5 * m2 * bx, f2y = m2 * (0.5 * by + g);
    double h1 = j1 * o.e1 - 0.5 * (o.u.x * f1y - o.u.y * f1x);
    double h2 = j2 * o.e2 - 0.5 * (o.w.x * f2y - o.w.y * f2x);
    double tx = f1x + f2x - lx, ty = f1y + f2y - ly;
    double c2 = o.w.x * ty - o.w.y * tx + h2;
    double px = (o.u.x * c2 + o.w.x * h1) * o.inv, py = (o.u.y * c2 + o.w.y * h1) * o.inv;
    pins r = {{px, py}, {f1x - px, f1y - py}, {tx - px, ty - py}};
    return r;
}

/* p: a w | O3 | AB BO3 s | O5 | BC CO5 s | m2 m3 m4 m5 | J2 J3 J4 J5 | g */
#define SIXBAR_DESIGN(p) \
    const double a = (p)[0], w = (p)[1], x3 = (p)[2], y3 = (p)[3], s3 = (p)[6], x5 = (p)[7], y5 = (p)[8], s5 = (p)[11]; \
    const double r3 = 4 * (p)[4] * (p)[4], k3 = (p)[4] * (p)[4] - (p)[5] * (p)[5]; \
    const double r5 = 4 * (p)[9] * (p)[9], k5 = (p)[9] * (p)[9] - (p)[10] * (p)[10]; \
    const double m2 = (p)[12], m3 = (p)[13], m4 = (p)[14], m5 = (p)[15]; \
    const double j2 = (p)[16], j3 = (p)[17], j4 = (p)[18], j5 = (p)[19], g = (p)[20];

#define SIXBAR(C, S) \
    double ax = a * (C), ay = a * (S), vax = -w * ay, vay = w * ax, aax = -w * w * ax, aay = -w * w * ay; \
    dyad o = solve_dyad(ax, ay, vax, vay, aax, aay, x3, y3, r3, k3, s3); \
    double bx = ax + o.u.x, by = ay + o.u.y, vbx = -o.w2 * o.w.y, vby = o.w2 * o.w.x, q2 = o.w2 * o.w2; \
    double abx = -o.e2 * o.w.y - q2 * o.w.x, aby = o.e2 * o.w.x - q2 * o.w.y; \
    dyad h = solve_dyad(bx, by, vbx, vby, abx, aby, x5, y5, r5, k5, s5); \
    double cx = bx + h.u.x, cy = by + h.u.y, vcx = -h.w2 * h.w.y, vcy = h.w2 * h.w.x, q5 = h.w2 * h.w2; \
    double acx = -h.e2 * h.w.y - q5 * h.w.x, acy = h.e2 * h.w.x - q5 * h.w.y; \
    pins f = dyad_forces(h, abx, aby, acx, acy, m4, j4, m5, j5, g, 0.0, 0.0); \
    pins e = dyad_forces(o, aax, aay, abx, aby, m2, j2, m3, j3, g, -f.p.x, -f.p.y); \
    double torque = ax * e.p.y - ay * e.p.x;

void sixbar(long n, const double *restrict C, const double *restrict S, const double *restrict p,
            double *restrict out)
{
    SIXBAR_DESIGN(p)
    #pragma omp simd
    for (long i = 0; i < n; i++) {
        SIXBAR(C[i], S[i])
        out[i] = ax;            out[n + i] = ay;        out[2 * n + i] = bx;    out[3 * n + i] = by;
        out[4 * n + i] = cx;    out[5 * n + i] = cy;    out[6 * n + i] = vax;   out[7 * n + i] = vay;
        out[8 * n + i] = vbx;   out[9 * n + i] = vby;   out[10 * n + i] = vcx;  out[11 * n + i] = vcy;
        out[12 * n + i] = aax;  out[13 * n + i] = aay;  out[14 * n + i] = abx;  out[15 * n + i] = aby;
        out[16 * n + i] = acx;  out[17 * n + i] = acy;  out[18 * n + i] = o.w1; out[19 * n + i] = o.w2;
        out[20 * n + i] = h.w1; out[21 * n + i] = h.w2; out[22 * n + i] = o.e1; out[23 * n + i] = o.e2;
        out[24 * n + i] = h.e1; out[25 * n + i] = h.e2;
        out[26 * n + i] = e.p.x; out[27 * n + i] = e.p.y; out[28 * n + i] = e.p.x; out[29 * n + i] = e.p.y;
        out[30 * n + i] = e.b.x; out[31 * n + i] = e.b.y; out[32 * n + i] = f.p.x; out[33 * n + i] = f.p.y;
        out[34 * n + i] = f.b.x; out[35 * n + i] = f.b.y; out[36 * n + i] = e.q.x; out[37 * n + i] = e.q.y;
        out[38 * n + i] = f.q.x; out[39 * n + i] = f.q.y; out[40 * n + i] = torque;
    }
}

/* per design: max torque², |F_O1|², |F_O3|², |F_O5|², |F_C|², |a_C|² */
void sixbar_sweep(long designs, long n, const double *restrict C, const double *restrict S,
                  const double *restrict table, double *restrict out)
{
    for (long j = 0; j < designs; j++) {
        SIXBAR_DESIGN(table + 21 * j)
        double m0 = -1, m1 = -1, m2_ = -1, m3_ = -1, m4_ = -1, m5_ = -1;
        #pragma omp simd reduction(max : m0, m1, m2_, m3_, m4_, m5_)
        for (long i = 0; i < n; i++) {
            SIXBAR(C[i], S[i])
            double t0 = torque * torque, t1 = e.p.x * e.p.x + e.p.y * e.p.y, t2 = e.q.x * e.q.x + e.q.y * e.q.y;
            double t3 = f.q.x * f.q.x + f.q.y * f.q.y, t4 = f.b.x * f.b.x + f.b.y * f.b.y, t5 = acx * acx + acy * acy;
            m0 = t0 > m0 ? t0 : m0;
            m1 = t1 > m1 ? t1 : m1;
            m2_ = t2 > m2_ ? t2 : m2_;
            m3_ = t3 > m3_ ? t3 : m3_;
            m4_ = t4 > m4_ ? t4 : m4_;
            m5_ = t5 > m5_ ? t5 : m5_;
        }
        double *r = out + 6 * j;
        r[0] = m0; r[1] = m1; r[2] = m2_; r[3] = m3_; r[4] = m4_; r[5] = m5_;
    }
}
