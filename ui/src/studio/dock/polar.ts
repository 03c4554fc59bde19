// The way of a vector's tip over the cycle, to equal scales, with the vector of the position that is shown.
import { type Colour, colours, painted } from "../../palette";

const EDGE = 12, HEAD = 8;

export class Polar {
  readonly end: () => void;
  private readonly canvas: HTMLCanvasElement;
  private readonly pen: CanvasRenderingContext2D;
  private x: ArrayLike<number> = [];
  private y: ArrayLike<number> = [];
  private colour: Colour = "accent";
  private closed = true;
  private tip: [number, number] = [0, 0];

  constructor(host: HTMLElement) {
    const { canvas, pen, end } = painted(host, () => this.paint());
    [this.canvas, this.pen, this.end] = [canvas, pen, end];
    canvas.setAttribute("role", "img");
    // As large as it will be at once: the observer comes a frame later.
    [canvas.width, canvas.height] = [host.clientWidth, host.clientHeight].map((each) => Math.round(each * (devicePixelRatio || 1)));
  }

  label(text: string): void {
    this.canvas.ariaLabel = text;
  }

  set(x: ArrayLike<number>, y: ArrayLike<number>, colour: Colour, closed: boolean): void {
    [this.x, this.y, this.colour, this.closed] = [x, y, colour, closed];
  }

  cursor(x: number, y: number): void {
    this.tip = [x, y];
    this.paint();
  }

  private paint(): void {
    const { canvas, pen, x, y } = this, dense = devicePixelRatio || 1, wide = canvas.width / dense, tall = canvas.height / dense, colour = colours();
    let [left, right, low, high] = [0, 0, 0, 0];
    for (let i = 0; i < x.length; i++) {
      [left, right] = [Math.min(left, x[i]), Math.max(right, x[i])];
      [low, high] = [Math.min(low, y[i]), Math.max(high, y[i])];
    }
    const scale = Math.min((wide - 2 * EDGE) / (right - left || 1), (tall - 2 * EDGE) / (high - low || 1));
    const u = (value: number) => wide / 2 + scale * (value - (left + right) / 2), v = (value: number) => tall / 2 - scale * (value - (low + high) / 2);
    pen.setTransform(dense, 0, 0, dense, 0, 0);
    pen.clearRect(0, 0, wide, tall);
    [pen.strokeStyle, pen.lineWidth, pen.lineJoin] = [colour.axis, 1, "round"];
    pen.stroke(new Path2D(`M0 ${v(0)}H${wide}M${u(0)} 0V${tall}`));
    const path = new Path2D();
    for (let i = 0; i < x.length; i++) path[i ? "lineTo" : "moveTo"](u(x[i]), v(y[i]));
    if (this.closed) path.closePath();
    [pen.strokeStyle, pen.lineWidth] = [colour[this.colour], 1.6];
    pen.stroke(path);
    const [a, b] = [u(this.tip[0]), v(this.tip[1])], length = Math.hypot(a - u(0), b - v(0));
    if (!(length > 1)) return;
    const [c, s] = [(a - u(0)) / length, (b - v(0)) / length], size = Math.min(HEAD, length);
    [pen.strokeStyle, pen.fillStyle, pen.lineWidth] = [colour.ink, colour.ink, 1.6];
    pen.stroke(new Path2D(`M${u(0)} ${v(0)}L${a - 0.7 * size * c} ${b - 0.7 * size * s}`));
    pen.beginPath();
    pen.moveTo(a, b);
    for (const side of [0.38, -0.38]) pen.lineTo(a - size * (c - side * s), b - size * (s + side * c));
    pen.fill();
  }
}
