/* Entries that take the address of all arguments, so that a call from Python costs as little as it can. */
#include "reference.c"

typedef struct {
    long designs, n;
    const double *cosine, *sine, *table;
    double *out;
} call;

void call_fourbar(const call *c) { fourbar(c->n, c->cosine, c->sine, c->table, c->out); }
void call_sixbar(const call *c) { sixbar(c->n, c->cosine, c->sine, c->table, c->out); }
void call_fourbar_sweep(const call *c) { fourbar_sweep(c->designs, c->n, c->cosine, c->sine, c->table, c->out); }
void call_sixbar_sweep(const call *c) { sixbar_sweep(c->designs, c->n, c->cosine, c->sine, c->table, c->out); }
