head();
tiles();
monitorCharts();
deviationChart();
energyChart();
await motion();
contactCharts();
toleranceTable();
deviationTable();
costChart();
provenance();
if (shown.end > 0) setTime(0);
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => location.reload());
// What a test asks for.
window.talus = {charts, films, shown, setTime, drawTimes};
document.documentElement.dataset.ready = 'yes';
