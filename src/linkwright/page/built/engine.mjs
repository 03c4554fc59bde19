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
	out: 8,
	starts: 9
}, t = 10, n = 4;
function r(e, t, n) {
	let r = e[0], i = 5 + r + 1, a = Math.floor((t - e[1]) / e[2]), o = e[3] === 0 ? t : t - a * e[2], s = 0;
	for (let t = r; t > 1;) {
		let n = t >> 1;
		e[5 + s + n] <= o && (s += n), t -= n;
	}
	let c = o - e[5 + s], l = i + 4 * s, [u, d, f, p] = [
		e[l],
		e[l + 1],
		e[l + 2],
		e[l + 3]
	];
	if (n === 0) {
		let t = u + c * (d + c * (f + c * p));
		return e[3] === 0 ? t : t + a * e[4];
	}
	return n === 1 ? d + c * (2 * f + 3 * p * c) : n === 2 ? 2 * f + 6 * p * c : 6 * p + 0 * c;
}
var i = class {
	program;
	n;
	parameters;
	positions = {};
	fields = {};
	starts;
	out;
	stride;
	rows = {};
	constructor(e, t, r, i) {
		this.program = e, this.n = t;
		let a = e.states.length > 0;
		this.stride = a ? t : Math.max(t, n), this.parameters = r.floats(e.parameters.length);
		for (let t of e.positions) this.positions[t] = r.floats(this.stride);
		for (let t of e.fields) this.fields[t] = r.floats(this.stride);
		this.starts = r.floats(e.states.length), this.out = r.floats(e.outputs.length * this.stride);
		let o = [
			...Object.values(this.positions),
			...Object.values(this.fields),
			...i
		];
		this.run = r.caller(this, o, i, a), e.outputs.forEach((e, n) => this.rows[e] = this.out.subarray(n * this.stride, n * this.stride + t));
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
}, a = class {
	program;
	room;
	tables;
	constructor(e, t, n = {}, r = 16) {
		this.program = e, this.room = "run" in t ? o(t.run) : s(t.module, r), this.tables = e.tables.map((e) => {
			let t = this.room.floats(n[e].length);
			return t.set(n[e]), t;
		});
	}
	call(e) {
		return new i(this.program, e, this.room, this.tables);
	}
};
function o(e) {
	return {
		floats: (e) => new Float64Array(e),
		caller: (t, n, r) => () => e(t.parameters, Object.values(t.positions), Object.values(t.fields), r, t.starts, t.out, t.stride)
	};
}
function s(e, n) {
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
	let { kernel: a } = new WebAssembly.Instance(e, { env: i }).exports, o = 1024, s = (e) => {
		let t = 8 * Math.max(e, 1) + 63 & -64;
		if (o + t > r.buffer.byteLength) throw RangeError("the page's memory is too small for this model");
		return o += t, new Float64Array(r.buffer, o - t, e);
	};
	return {
		floats: s,
		caller: (e, n, i, o) => {
			let l = new BigInt64Array(r.buffer, s(t + n.length).byteOffset, t + n.length);
			c(l, e, n, o);
			let u = l.byteOffset;
			return () => a(u);
		}
	};
}
function c(r, i, a, o) {
	let s = (e, t) => r[e] = BigInt(t), c = i.n, l = c % n, u = c - l;
	s(e.designs, 1), s(e.length, i.stride), s(e.count, c), s(e.fullEnd, u);
	let [d, f, p] = u ? l ? [
		c - n,
		n - l,
		n
	] : [
		-1,
		0,
		0
	] : [
		0,
		0,
		l
	];
	o || (s(e.tailStart, d), s(e.tailLow, f), s(e.tailHigh, p)), s(e.parameters, i.parameters.byteOffset), s(e.out, i.out.byteOffset), s(e.starts, i.starts.byteOffset), a.forEach((e, n) => s(t + n, e.byteOffset));
}
export { i as Call, a as Kernel, r as look };
