// src/engine.ts
var e = {
	designs: 0,
	length: 1,
	count: 2,
	fullEnd: 3,
	tailStart: 4,
	tailLow: 5,
	tailHigh: 6,
	parameters: 7,
	out: 8
}, t = 9, n = 4, r = class {
	program;
	n;
	parameters;
	positions = {};
	fields = {};
	out;
	stride;
	rows = {};
	constructor(e, t, r, i) {
		this.program = e, this.n = t, this.stride = Math.max(t, n), this.parameters = r.floats(e.parameters.length);
		for (let t of e.positions) this.positions[t] = r.floats(this.stride);
		for (let t of e.fields) this.fields[t] = r.floats(this.stride);
		this.out = r.floats(e.outputs.length * this.stride);
		let a = [
			...Object.values(this.positions),
			...Object.values(this.fields),
			...i
		];
		this.run = r.caller(this, a), e.outputs.forEach((e, n) => this.rows[e] = this.out.subarray(n * this.stride, n * this.stride + t));
	}
	run;
	row(e) {
		return this.rows[e];
	}
	has(e) {
		return e in this.rows;
	}
	set(e) {
		this.program.parameters.forEach((t, n) => this.parameters[n] = e[t]);
	}
	give(e) {
		for (let t of [this.positions, this.fields]) for (let n in t) {
			let r = e[n];
			if (r) for (let e = 0; e < this.stride; e++) t[n][e] = r[Math.min(e, r.length - 1)];
		}
	}
}, i = /* @__PURE__ */ new WeakMap();
function a({ program: e, out: t, stride: n }) {
	let r = e.outputs.map((e, r) => t[r * n]), a = i.get(e);
	a || i.set(e, a = new Map(e.outputs.map((e, t) => [e, t])));
	let o = a;
	return {
		row: (e) => [r[o.get(e)]],
		has: (e) => o.has(e)
	};
}
var o = (e) => (t) => new WebAssembly.Instance(e, { env: t }).exports.kernel, s = class {
	program;
	room;
	tables;
	constructor(e, t, n = {}, r = 16) {
		this.program = e, this.room = c(t, r), this.tables = e.tables.map((e) => {
			let t = this.room.floats(n[e].length);
			return t.set(n[e]), t;
		});
	}
	call(e) {
		return new r(this.program, e, this.room, this.tables);
	}
};
function c(e, n) {
	let r = new WebAssembly.Memory({ initial: n * 1048576 / 65536 }), i = { __linear_memory: r };
	for (let e of [
		"sin",
		"cos",
		"tan",
		"asin",
		"acos",
		"atan",
		"atan2",
		"exp",
		"log",
		"pow"
	]) i[`linkwright_${e}`] = Math[e];
	let a = e(i), o = 1024, s = (e) => {
		let t = 8 * Math.max(e, 1) + 63 & -64;
		if (o + t > r.buffer.byteLength) throw RangeError("the page's memory is too small for this model");
		return o += t, new Float64Array(r.buffer, o - t, e);
	};
	return {
		floats: s,
		caller: (e, n) => {
			let i = new BigInt64Array(r.buffer, s(t + n.length).byteOffset, t + n.length);
			l(i, e, n);
			let o = i.byteOffset;
			return () => a(o);
		}
	};
}
function l(r, i, a) {
	let o = (e, t) => r[e] = BigInt(t), s = i.n, c = s % n, l = s - c;
	o(e.designs, 1), o(e.length, i.stride), o(e.count, s), o(e.fullEnd, l);
	let [u, d, f] = l ? c ? [
		s - n,
		n - c,
		n
	] : [
		-1,
		0,
		0
	] : [
		0,
		0,
		c
	];
	o(e.tailStart, u), o(e.tailLow, d), o(e.tailHigh, f), o(e.parameters, i.parameters.byteOffset), o(e.out, i.out.byteOffset), a.forEach((e, n) => o(t + n, e.byteOffset));
}
export { r as Call, s as Kernel, o as moduleCode, a as taken };
