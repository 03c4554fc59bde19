// Names as they are printed: those of points slanted, with a number behind them as an index.
const POINT = /^(\p{Lu}\p{L}?'*)_?(\d*'*)$/u;

function One({ word }: { word: string }) {
  const [owner, name] = word.includes(".") ? [word.slice(0, word.lastIndexOf(".") + 1), word.slice(word.lastIndexOf(".") + 1)] : ["", word], [, stem, index] = POINT.exec(name) ?? [];
  return stem ? <>{owner}<i class="sym">{stem}{index && <sub>{index}</sub>}</i></> : <>{word}</>;
}

export function Name({ text }: { text: string }) {
  return <>{text.split(/([\s,，]+)/).map((word, k) => <One key={k} word={word} />)}</>;
}
