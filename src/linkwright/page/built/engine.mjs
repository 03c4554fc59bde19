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
	programs;
	room;
	tables;
	constructor(e, n, r = {}, i = 16) {
		if (this.programs = e, "functions" in n) {
			this.tables = Object.fromEntries(Object.entries(r).map(([e, t]) => [e, Float64Array.from(t)]));
			let e = (e) => new Float64Array(e);
			this.room = (t) => ({
				floats: e,
				caller: (e, r, i) => () => n.functions[t](e.parameters, Object.values(e.positions), Object.values(e.fields), i, e.starts, e.out, e.stride)
			});
			return;
		}
		let a = new WebAssembly.Memory({ initial: i * 1048576 / 65536 }), s = { __linear_memory: a };
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
		]) s[`linkwright_${e}`] = Math[e];
		let c = new WebAssembly.Instance(n.module, { env: s }).exports, l = 1024, u = (e) => {
			let t = 8 * Math.max(e, 1) + 63 & -64;
			if (l + t > a.buffer.byteLength) throw RangeError("the page's memory is too small for this model");
			return l += t, new Float64Array(a.buffer, l - t, e);
		};
		this.tables = Object.fromEntries(Object.entries(r).map(([e, t]) => {
			let n = u(t.length);
			return n.set(t), [e, n];
		})), this.room = (e) => ({
			floats: u,
			caller: (n, r, i, s) => {
				let l = new BigInt64Array(a.buffer, u(t + r.length).byteOffset, t + r.length);
				o(l, n, r, s);
				let d = c[`kernel${e}`], f = l.byteOffset;
				return () => d(f);
			}
		});
	}
	call(e, t) {
		let n = this.programs[e];
		return new i(n, t, this.room(e), n.tables.map((e) => this.tables[e]));
	}
};
function o(r, i, a, o) {
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
var s = class {
	calls;
	kept = {};
	constructor(e, t, n) {
		this.calls = t.map((t) => {
			let r = t.steps ?? n;
			return {
				stage: t,
				call: e.call(t.kernel, r),
				after: t.after === null ? null : e.call(t.after, 1),
				keep: t.keep === null ? null : e.call(t.keep, r)
			};
		});
	}
	run(e, t) {
		let n = { ...e }, r = {}, i = !1;
		for (let { stage: e, call: a, after: o, keep: s } of this.calls) {
			c(a, e, n, t, this.kept);
			let d = u(e, a), f = {};
			for (let { name: t, output: n, kind: r, of: i } of e.reductions) f[t] = d(n, r, i);
			let p = d("", "valid", "");
			if (o) {
				o.program.parameters.forEach((e, t) => o.parameters[t] = n[e] ?? l(e, d)), o.run();
				for (let e of o.program.outputs) f[e] = o.row(e)[0];
			}
			if (e.count && (f[e.count] = p), i ||= e.complete && p !== a.n, i) for (let e in f) f[e] = NaN;
			if (s) {
				c(s, e, n, t, this.kept);
				for (let e of s.program.outputs) this.kept[e] = s.row(e);
			}
			Object.assign(n, f), Object.assign(r, f);
		}
		return r;
	}
};
function c(e, t, n, r, i) {
	e.set(n), e.give(r), e.give(i), e.program.states.forEach((r, i) => {
		let a = t.starts[r];
		e.starts[i] = typeof a == "string" ? n[a] : a;
	}), e.run();
}
function l(e, t) {
	if (e === "valid.count") return t("", "valid", "");
	for (let n of ["at_min", "at_max"]) {
		let r = e.indexOf(`.${n}.`);
		if (r >= 0) return t(e.slice(0, r), n, e.slice(r + n.length + 2));
	}
	let n = e.lastIndexOf(".");
	return t(e.slice(0, n), e.slice(n + 1), "");
}
function u(e, t) {
	let { n } = t, r = e.valid !== null && t.has(e.valid) ? t.row(e.valid) : null, i = [];
	for (let e = 0; e < n; e++) r && r[e] === 0 || i.push(e);
	let a = (e) => e === "#" ? (e) => e : (n) => t.row(e)[n], o = (e, t) => {
		let n = a(e), r = Infinity, o = -1;
		for (let e of i) t * n(e) < r && ([r, o] = [t * n(e), e]);
		return o;
	}, s = (e, t) => i.reduce((n, r) => n + t(a(e)(r)), 0);
	return (e, t, n) => {
		let r = (e, t) => e < 0 ? NaN : a(t)(e);
		switch (t) {
			case "min": return r(o(e, 1), e);
			case "max": return r(o(e, -1), e);
			case "argmin": return o(e, 1);
			case "argmax": return o(e, -1);
			case "at_min": return r(o(n, 1), e);
			case "at_max": return r(o(n, -1), e);
			case "first": return r(i[0] ?? -1, e);
			case "last": return r(i[i.length - 1] ?? -1, e);
			case "sum": return s(e, (e) => e);
			case "mean": return s(e, (e) => e) / i.length;
			case "rms": return Math.sqrt(s(e, (e) => e * e) / i.length);
			case "count": return s(e, (e) => e === 0 ? 0 : 1);
			case "valid": return i.length;
			default: throw Error(`no reduction ${t}`);
		}
	};
}
export { i as Call, s as Cycle, a as Kernels, r as look, u as reduce };
