// What lies behind the drawing: a target curve, a photo.
import type { Photo } from "../bench";
import { Act, Quantity, Row, Switch } from "./fields";
import { Head } from "./head";
import { inUnit, si } from "./quantities";
import type { PanelProps } from "./selected";

export function CurvePanel({ bench, item }: PanelProps) {
  const { say } = bench, { value: target } = bench.target;
  const remove = () => {
    bench.target.value = null;
    bench.select();
  };
  return (
    <>
      <Head bench={bench} icon="target" title={say("tool.target")} item={item} fixedName remove={remove}>
        {target ? say(target.closed ? "insp.target_closed" : "insp.target_open", { count: String(target.points.length) }) : say("insp.target_about")}
      </Head>
      {target && <div class="form"><Switch label={say("insp.closed")} on={target.closed} set={(closed) => (bench.target.value = { ...target, closed })} /></div>}
      <div class="row-acts"><Act icon="synthesis" act={() => (bench.dock.value = "synthesis")}>{say("insp.to_synthesis")}</Act></div>
    </>
  );
}

export function PhotoPanel({ bench, item }: PanelProps) {
  const { say } = bench, { value: photo } = bench.photo, { unit } = bench.settings.value;
  const remove = () => {
    bench.photo.value = null;
    bench.select();
  };
  const change = (part: Partial<Photo>) => photo && (bench.photo.value = { ...photo, ...part });
  const widen = async (text: string) => {
    const width = si(text);
    if (!(width > 0)) return say("insp.no_length", { text });
    change({ width });
    return null;
  };
  return (
    <>
      <Head bench={bench} icon="photo" title={say("tool.photo")} item={item} fixedName remove={remove}>{say("insp.photo_about")}</Head>
      {photo && (
        <div class="form">
          <Quantity label={say("insp.photo_width")} value={`${inUnit(photo.width, unit)} ${unit}`} unit={unit} set={photo.locked ? undefined : widen} />
          <Row label={say("insp.opacity")}>
            <input class="slider" type="range" min="0.05" max="1" step="0.05" value={photo.opacity} aria-label={say("insp.opacity")} onInput={(event) => change({ opacity: Number(event.currentTarget.value) })} />
          </Row>
          <Switch label={say("insp.photo_locked")} on={photo.locked} set={(locked) => change({ locked })} />
        </div>
      )}
    </>
  );
}
